// SPDX-License-Identifier: MIT
#include "common/net/send_pace.h"

#include <algorithm>

#include "common/net/await.h"
#include "common/net/tcp_kernel.h"
#include "common/net/tcp_stream.h"

namespace selvage {
namespace {

using asio::ip::tcp;

/// Long enough for a busy server to come round again, short enough for people not to notice.
constexpr std::uint64_t kWritesPerSecond = 64;
/// Before anything was delivered: a round trip below which a link is taken for a fast one, and what a write
/// carries on others, which is about what TCP sends at first.
constexpr std::uint32_t kNearMicroseconds = 2000;
constexpr std::size_t kFirstFarWrite = 16u << 10;
/// Below this a write waits until the last one is nearly gone. Above, the kernel's own limit is close enough.
constexpr std::size_t kWaitBelow = 128u << 10;
/// What is measured moves by less than a third all the time.
constexpr std::size_t kWorthwhile = 3;
constexpr unsigned kFastWritesBetweenMeasures = 32;

}  // namespace

SendPace::SendPace(tcp::socket& socket) : socket_(socket) {
  const auto figures = tcp_figures(socket_.native_handle());  // the handshake has measured the round trip
  const bool is_near = figures && figures->round_trip_us < kNearMicroseconds;
  set_write_size(is_near ? kMostWrite : kFirstFarWrite);
}

void SendPace::set_write_size(std::size_t bytes) {
  write_size_ = bytes;
  limit_unsent(socket_.native_handle(), static_cast<std::uint32_t>(2 * bytes));
}

void SendPace::measure() {
  writes_until_measure_ = write_size_ == kMostWrite ? kFastWritesBetweenMeasures : 1;
  const auto figures = tcp_figures(socket_.native_handle());
  if (!figures || figures->bytes_per_second == 0) return;
  const auto size =
      std::clamp<std::uint64_t>(figures->bytes_per_second / kWritesPerSecond, kLeastWrite, kMostWrite);
  const std::size_t change = size > write_size_ ? size - write_size_ : write_size_ - size;
  if (change > write_size_ / kWorthwhile || (change > 0 && size == kMostWrite)) set_write_size(size);
}

bool SendPace::must_wait() {
  if (writes_until_measure_-- == 0) measure();
  return write_size_ < kWaitBelow;
}

asio::awaitable<Result<void>> SendPace::wait() {
  if (!must_wait()) co_return Result<void>();
  if (!socket_.is_open()) co_return connection_failure(asio::error::operation_aborted);
  auto [error] = co_await socket_.async_wait(tcp::socket::wait_write, kAwait);
  if (error) co_return connection_failure(error);
  co_return Result<void>();
}

}  // namespace selvage
