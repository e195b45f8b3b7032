// SPDX-License-Identifier: MIT
#include "client/load/send_garbage.h"

#include <random>

#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/await.h"
#include "common/net/messages.h"

namespace selvage {
namespace {

/// Longer than any server waits for a frame to be completed.
constexpr std::chrono::seconds kPatience{150};

std::vector<std::byte> nonsense(std::uint64_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes;
  if (seed % 2 == 0) bytes = to_frame(Hello{.software = "garbage"}, 0);
  if (seed % 4 == 0) {
    // The header of a frame that is larger than any server takes.
    const std::vector<std::byte> head = to_frame(OpenModel{.name = "x"}, 1);
    bytes.insert(bytes.end(), head.begin(), head.begin() + kFrameHeaderSize);
    bytes[bytes.size() - kFrameHeaderSize + 2] = std::byte{0xFF};
  }
  for (std::uint64_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(random()));
  return bytes;
}

asio::awaitable<void> read_to_the_end(ByteStream& stream) {
  std::vector<std::byte> ignored(4096);
  Result<std::size_t> count = std::size_t{1};
  while (count && *count > 0) count = co_await stream.read_some(ignored);
}

asio::awaitable<void> patience() {
  asio::steady_timer timer(co_await asio::this_coro::executor, kPatience);
  co_await timer.async_wait(kAwait);
}

}  // namespace

asio::awaitable<Result<void>> send_garbage(HostPort server, std::uint64_t size, std::uint32_t seed) {
  using namespace asio::experimental::awaitable_operators;
  Result<std::unique_ptr<ByteStream>> stream =
      co_await connect_tcp(server.host, server.port, std::chrono::seconds(10));
  if (!stream) co_return forward_error(stream);
  const std::vector<std::byte> bytes = nonsense(size, seed);
  const Pieces pieces(1, bytes);
  const Result<void> written = co_await (*stream)->write(pieces);  // the server may hang up first
  (void)written;
  auto reading = read_to_the_end(**stream);
  auto waiting = patience();
  const auto first = co_await (std::move(reading) || std::move(waiting));
  (*stream)->close();
  if (first.index() == 1) co_return fail(ErrorCode::Timeout, "the server goes on listening to garbage");
  co_return Result<void>();
}

}  // namespace selvage
