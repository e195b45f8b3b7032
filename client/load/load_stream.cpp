// SPDX-License-Identifier: MIT
#include "client/load/load_stream.h"

#include <algorithm>
#include <deque>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/await.h"
#include "common/net/signal.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;

/// As much as a slow link gives at once: about what it sends in a twentieth of a second.
std::size_t quantum(std::uint64_t bytes_per_second) {
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(bytes_per_second / 20, 1500, 256u << 10));
}

/// Writes on their way; outlives the stream until the last has left.
struct Uplink {
  Uplink(std::unique_ptr<ByteStream> s, std::chrono::milliseconds d) : stream(std::move(s)), delay(d) {}

  struct Waiting {
    Clock::time_point due;
    std::vector<std::byte> bytes;
  };

  std::unique_ptr<ByteStream> stream;
  const std::chrono::milliseconds delay;
  std::deque<Waiting> waiting;
  Signal wakes;
  bool closed = false;
};

/// Writes what is due. A write that fails says less than the next read will.
asio::awaitable<void> pump(std::shared_ptr<Uplink> uplink) {
  asio::steady_timer timer(uplink->stream->executor());
  while (!uplink->closed) {
    if (uplink->waiting.empty()) {
      co_await uplink->wakes.wait();
      continue;
    }
    timer.expires_at(uplink->waiting.front().due);
    co_await timer.async_wait(kAwait);
    if (uplink->closed) break;
    const std::vector<std::byte> bytes = std::move(uplink->waiting.front().bytes);
    uplink->waiting.pop_front();
    const Pieces pieces(1, bytes);
    const Result<void> written = co_await uplink->stream->write(pieces);
    if (!written) break;
  }
}

class LoadStream final : public ByteStream {
 public:
  LoadStream(std::unique_ptr<ByteStream> stream, const LinkShape& link, StreamMeter& meter)
      : uplink_(std::make_shared<Uplink>(std::move(stream), link.round_trip)),
        rate_(link.bytes_per_second),
        meter_(meter),
        timer_(uplink_->stream->executor()) {
    if (link.round_trip.count() > 0)
      asio::co_spawn(uplink_->stream->executor(), pump(uplink_), asio::detached);
  }
  ~LoadStream() override { close(); }

  asio::awaitable<Result<void>> handshake() override {
    Result<void> ready = co_await uplink_->stream->handshake();
    co_return ready;
  }

  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    if (rate_ > 0) {
      into = into.first(std::min(into.size(), quantum(rate_)));
      timer_.expires_at(next_read_);
      co_await timer_.async_wait(kAwait);
    }
    while (meter_.is_stalled && !uplink_->closed) {
      timer_.expires_after(std::chrono::hours(1));  // closing ends it
      co_await timer_.async_wait(kAwait);
    }
    Result<std::size_t> count = co_await uplink_->stream->read_some(into);
    if (!count) co_return count;
    meter_.received += *count;
    if (meter_.has_broken()) {
      close();
      co_return fail(ErrorCode::Io, "the connection was dropped, as the script says");
    }
    if (rate_ > 0) {
      const std::chrono::duration<double> takes(static_cast<double>(*count) / static_cast<double>(rate_));
      next_read_ = std::max(next_read_, Clock::now()) + std::chrono::duration_cast<Clock::duration>(takes);
    }
    co_return count;
  }

  asio::awaitable<Result<void>> write(const Pieces& pieces) override {
    if (uplink_->delay.count() == 0) {
      Result<void> written = co_await uplink_->stream->write(pieces);
      co_return written;
    }
    Uplink::Waiting one{Clock::now() + uplink_->delay, {}};
    for (const Piece& piece : pieces)
      one.bytes.insert(one.bytes.end(), piece.bytes.begin(), piece.bytes.end());
    uplink_->waiting.push_back(std::move(one));
    uplink_->wakes.notify();
    co_return Result<void>();
  }

  void end_writing() override { uplink_->stream->end_writing(); }

  void close() override {
    uplink_->closed = true;
    uplink_->wakes.notify();
    timer_.cancel();
    uplink_->stream->close();
  }

  asio::any_io_executor executor() override { return uplink_->stream->executor(); }
  std::string peer() const override { return uplink_->stream->peer(); }

 private:
  std::shared_ptr<Uplink> uplink_;
  const std::uint64_t rate_;
  StreamMeter& meter_;
  asio::steady_timer timer_;
  Clock::time_point next_read_{};
};

}  // namespace

std::unique_ptr<ByteStream> make_load_stream(std::unique_ptr<ByteStream> stream, const LinkShape& link,
                                             StreamMeter& meter) {
  return std::make_unique<LoadStream>(std::move(stream), link, meter);
}

}  // namespace selvage
