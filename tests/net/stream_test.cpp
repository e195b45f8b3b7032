// SPDX-License-Identifier: MIT
//
// Streams, deadlines and signals: what waits.
#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/io_context.hpp>

#include "common/net/deadline.h"
#include "common/net/frame_io.h"
#include "common/net/messages.h"
#include "common/net/signal.h"
#include "common/net/tcp_stream.h"
#include "tests/support/memory_stream.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using testing::make_memory_streams;

/// Runs a coroutine on a thread of its own making: this one.
template <class Work>
void run(Work work) {
  asio::io_context io;
  std::exception_ptr thrown;
  asio::co_spawn(io, work(), [&](std::exception_ptr exception) { thrown = exception; });
  io.run();
  if (thrown) std::rethrow_exception(thrown);
}

TEST(Signal, IsNotLostWhenItComesBeforeTheWait) {
  run([]() -> asio::awaitable<void> {
    Signal signal;
    signal.notify();
    signal.notify();
    co_await signal.wait();
  });
}

TEST(Deadline, PassesEvenWhenBroughtForward) {
  run([]() -> asio::awaitable<void> {
    using namespace asio::experimental::awaitable_operators;
    Deadline deadline(co_await asio::this_coro::executor);
    deadline.expires_after(1h);
    auto bring_forward = [](Deadline& moved) -> asio::awaitable<void> {
      moved.expires_after(1ms);
      co_return;
    };
    auto expired = deadline.expired();
    auto moves = bring_forward(deadline);
    co_await (std::move(expired) && std::move(moves));
  });
}

TEST(Deadline, LosesToWhateverEndsFirst) {
  run([]() -> asio::awaitable<void> {
    using namespace asio::experimental::awaitable_operators;
    const asio::any_io_executor executor = co_await asio::this_coro::executor;
    Deadline late(executor), soon(executor);
    late.expires_after(1h);
    soon.expires_after(1ms);
    auto a = late.expired();
    auto b = soon.expired();
    const auto first = co_await (std::move(a) || std::move(b));
    EXPECT_EQ(first.index(), 1u);
  });
}

TEST(FrameIo, TellsACleanEndFromACutFrame) {
  run([]() -> asio::awaitable<void> {
    // Not a list in braces: g++ 12 loses the array behind one in a coroutine.
    static constexpr std::size_t kCuts[] = {0, 5, kFrameHeaderSize, kFrameHeaderSize + 2};
    const asio::any_io_executor executor = co_await asio::this_coro::executor;
    for (const std::size_t cut : kCuts) {
      auto [here, there] = make_memory_streams(executor);
      const auto frame = to_frame(OpenModel{"bunny"}, 1);
      Pieces pieces;
      pieces.push_back(frame);
      pieces.push_back(std::span(frame).first(cut));
      const auto written = co_await here->write(pieces);
      EXPECT_TRUE(written);
      here->close();
      FrameBuffer buffer(kMaxPayload, 64);
      const auto whole = co_await read_frame(*there, buffer);
      EXPECT_TRUE(whole && whole->has_value());
      const auto end = co_await read_frame(*there, buffer);
      if (cut == 0) {
        EXPECT_TRUE(end && !end->has_value());
      } else {
        EXPECT_FALSE(end);
      }
    }
  });
}

TEST(HostPort, ParsesWhatPeopleWrite) {
  EXPECT_EQ(parse_host_port("example.org:80")->host, "example.org");
  EXPECT_EQ(parse_host_port("example.org:80")->port, 80);
  EXPECT_EQ(parse_host_port(":80")->host, "127.0.0.1");
  EXPECT_EQ(parse_host_port("[::1]:80")->host, "::1");
  EXPECT_EQ(parse_host_port("[::1]:80")->to_string(), "[::1]:80");
}

TEST(HostPort, RefusesTheRest) {
  for (const char* bad : {"", "host", "host:", "host:http", "host:65536", "host:-1", "::1:80", "host:80 "}) {
    EXPECT_FALSE(parse_host_port(bad)) << bad;
  }
}

}  // namespace
}  // namespace selvage
