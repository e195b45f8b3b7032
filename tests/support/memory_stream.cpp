// SPDX-License-Identifier: MIT
#include "tests/support/memory_stream.h"

#include <algorithm>
#include <deque>

#include "common/net/signal.h"

namespace selvage::testing {
namespace {

/// One direction.
struct Pipe {
  explicit Pipe(std::size_t most) : capacity(most) {}

  void close() {
    closed = true;
    readable.notify();
    writable.notify();
  }

  const std::size_t capacity;
  std::deque<std::byte> bytes;
  bool closed = false;
  Signal readable, writable;
};

class MemoryStream final : public ByteStream {
 public:
  MemoryStream(asio::any_io_executor executor, std::shared_ptr<Pipe> in, std::shared_ptr<Pipe> out,
               std::shared_ptr<FaultPlan> fault, std::size_t read_limit)
      : executor_(executor),
        in_(std::move(in)),
        out_(std::move(out)),
        fault_(std::move(fault)),
        read_limit_(read_limit) {}
  ~MemoryStream() override { close(); }

  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    if (fails()) co_return fail(ErrorCode::Io, "this read fails");
    while (in_->bytes.empty() && !in_->closed) co_await in_->readable.wait();
    if (closed_) co_return fail(ErrorCode::Cancelled, "the connection was closed");
    const std::size_t count = std::min({into.size(), in_->bytes.size(), read_limit_});
    const auto end = in_->bytes.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(in_->bytes.begin(), end, into.begin());
    in_->bytes.erase(in_->bytes.begin(), end);
    in_->writable.notify();
    co_return count;
  }

  asio::awaitable<Result<void>> write(const Pieces& pieces) override {
    if (fails()) co_return fail(ErrorCode::Io, "this write fails");
    for (const Piece& piece : pieces) {
      std::span<const std::byte> left = piece.bytes;
      while (!left.empty()) {
        while (out_->bytes.size() >= out_->capacity && !out_->closed) co_await out_->writable.wait();
        if (out_->closed) co_return fail(ErrorCode::Io, "the other side has gone");
        left = left.subspan(put(left));
      }
    }
    co_return Result<void>();
  }

  bool may_write_at_once() override { return !closed_; }

  std::size_t write_at_once(const Pieces& pieces) override {
    std::size_t written = 0;
    if (fails()) return written;
    for (const Piece& piece : pieces) written += put(piece.bytes);
    return written;
  }

  void end_writing() override { out_->close(); }

  void close() override {
    closed_ = true;
    in_->close();
    out_->close();
  }

  asio::any_io_executor executor() override { return executor_; }
  std::string peer() const override { return "memory"; }

 private:
  /// As much as there is room for.
  std::size_t put(std::span<const std::byte> bytes) {
    if (out_->closed) return 0;
    const std::size_t count = std::min(bytes.size(), out_->capacity - out_->bytes.size());
    out_->bytes.insert(out_->bytes.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    out_->readable.notify();
    return count;
  }

  bool fails() {
    if (fault_->operations++ != fault_->fails_at) return closed_;
    close();
    return true;
  }

  asio::any_io_executor executor_;
  std::shared_ptr<Pipe> in_, out_;
  std::shared_ptr<FaultPlan> fault_;
  std::size_t read_limit_;
  bool closed_ = false;
};

}  // namespace

StreamPair make_memory_streams(asio::any_io_executor executor, MemoryStreamOptions options) {
  const auto there = std::make_shared<Pipe>(options.capacity);
  const auto back = std::make_shared<Pipe>(options.capacity);
  return {std::make_unique<MemoryStream>(executor, back, there, options.first_fault, options.read_limit),
          std::make_unique<MemoryStream>(executor, there, back, options.second_fault, options.read_limit)};
}

}  // namespace selvage::testing
