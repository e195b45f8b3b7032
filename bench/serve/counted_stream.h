// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "common/net/byte_stream.h"

namespace selvage::bench {

/// Another stream, whose received bytes are counted as they arrive, frames or not.
class CountedStream final : public ByteStream {
 public:
  CountedStream(std::unique_ptr<ByteStream> stream, std::uint64_t& received)
      : stream_(std::move(stream)), received_(received) {}

  asio::awaitable<Result<void>> handshake() override { return stream_->handshake(); }
  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    Result<std::size_t> count = co_await stream_->read_some(into);
    if (count) received_ += *count;
    co_return count;
  }
  asio::awaitable<Result<void>> write(const Pieces& pieces) override { return stream_->write(pieces); }
  void end_writing() override { stream_->end_writing(); }
  void close() override { stream_->close(); }
  asio::any_io_executor executor() override { return stream_->executor(); }
  std::string peer() const override { return stream_->peer(); }

 private:
  std::unique_ptr<ByteStream> stream_;
  std::uint64_t& received_;
};

}  // namespace selvage::bench
