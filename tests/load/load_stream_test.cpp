// SPDX-License-Identifier: MIT
#include "client/load/load_stream.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include "tests/support/memory_stream.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Work = asio::awaitable<void>;

void run(asio::io_context& io, Work work) {
  std::exception_ptr thrown;
  asio::co_spawn(io, std::move(work), [&](std::exception_ptr e) { thrown = e; });
  io.run();
  if (thrown) std::rethrow_exception(thrown);
}

Work write_all(ByteStream& stream, std::size_t size) {
  const std::vector<std::byte> bytes(size);
  const Pieces pieces(1, bytes);
  const Result<void> written = co_await stream.write(pieces);
  EXPECT_TRUE(written);
}

Work read_all(ByteStream& stream, std::size_t size) {
  std::vector<std::byte> into(64 << 10);
  for (std::size_t count = 0; count < size;) {
    const Result<std::size_t> read = co_await stream.read_some(into);
    EXPECT_TRUE(read);
    if (!read || *read == 0) co_return;
    count += *read;
  }
}

TEST(LoadStream, ReadsNoFasterThanItsLink) {
  asio::io_context io;
  auto [near, far] = testing::make_memory_streams(io.get_executor(), {.capacity = 1 << 20});
  StreamMeter meter;
  const auto stream = make_load_stream(std::move(near), {.bytes_per_second = 1'000'000}, meter);
  const auto begin = Clock::now();
  const auto work = [](ByteStream& from, ByteStream& to) -> Work {
    co_await write_all(from, 100'000);
    co_await read_all(to, 100'000);
    from.close();
    to.close();
  };
  run(io, work(*far, *stream));
  EXPECT_GE(Clock::now() - begin, 50ms);  // the last piece may come at once
  EXPECT_EQ(meter.received, 100'000u);
}

TEST(LoadStream, WritesLeaveARoundTripLaterInOrder) {
  asio::io_context io;
  auto [near, far] = testing::make_memory_streams(io.get_executor());
  StreamMeter meter;
  const auto stream = make_load_stream(std::move(near), {.round_trip = 20ms}, meter);
  const auto begin = Clock::now();
  const auto work = [](ByteStream& from, ByteStream& to) -> Work {
    for (std::uint8_t i = 0; i < 10; ++i) {
      const std::vector<std::byte> bytes(10, std::byte{i});
      const Pieces pieces(1, bytes);
      const Result<void> written = co_await from.write(pieces);
      EXPECT_TRUE(written);
    }
    std::vector<std::byte> got, into(1000);
    while (got.size() < 100) {
      const Result<std::size_t> count = co_await to.read_some(into);
      EXPECT_TRUE(count);
      if (!count || *count == 0) co_return;
      got.insert(got.end(), into.begin(), into.begin() + static_cast<std::ptrdiff_t>(*count));
    }
    EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
    from.close();
    to.close();
  };
  run(io, work(*stream, *far));
  EXPECT_GE(Clock::now() - begin, 20ms);
}

TEST(LoadStream, BreaksWhereItIsTold) {
  asio::io_context io;
  auto [near, far] = testing::make_memory_streams(io.get_executor(), {.read_limit = 1000});
  StreamMeter meter;
  meter.break_at = 5000;
  const auto stream = make_load_stream(std::move(near), {}, meter);
  const auto work = [](ByteStream& from, ByteStream& to) -> Work {
    co_await write_all(from, 20'000);
    std::vector<std::byte> into(64 << 10);
    Result<std::size_t> read = std::size_t{1};
    while (read && *read > 0) read = co_await to.read_some(into);
    EXPECT_FALSE(read);
    from.close();
  };
  run(io, work(*far, *stream));
  EXPECT_TRUE(meter.has_broken());
  EXPECT_EQ(meter.received, 5000u);
}

}  // namespace
}  // namespace selvage
