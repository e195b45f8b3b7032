// SPDX-License-Identifier: MIT
//
// A peer without manners: sends what frames or bytes a test likes, and looks at what comes back.
#pragma once

#include <optional>
#include <vector>

#include "common/net/byte_stream.h"
#include "common/net/frame_io.h"
#include "common/net/messages.h"

namespace selvage::testing {

class RawPeer {
 public:
  /// A frame that outlives the next read.
  struct Received {
    FrameHeader header;
    std::vector<std::byte> payload;

    bool is(FrameType type) const { return header.type == type; }
    template <class Message>
    Message as() const {
      return parse<Message>(payload).value();  // throws where the test expects another frame
    }
  };

  explicit RawPeer(std::unique_ptr<ByteStream> stream) : stream_(std::move(stream)) {}

  template <class Message>
  asio::awaitable<void> send(Message message, std::uint32_t request_id = 0, std::uint32_t seq = 0) {
    std::vector<std::byte> bytes = to_frame(message, request_id, seq);
    co_await send_bytes(std::move(bytes));
  }

  asio::awaitable<void> send_data(std::uint32_t request_id, std::uint32_t seq, std::vector<std::byte> data,
                                  bool end) {
    std::vector<std::byte> bytes(kFrameHeaderSize);
    const FrameHeader header{static_cast<std::uint32_t>(data.size()), FrameType::Data,
                             end ? kFlagEnd : std::uint8_t{0}, request_id, seq};
    write_header(header, HeaderBytes(bytes.data(), kFrameHeaderSize));
    bytes.insert(bytes.end(), data.begin(), data.end());
    co_await send_bytes(std::move(bytes));
  }

  asio::awaitable<void> send_bytes(std::vector<std::byte> bytes) {
    const Pieces pieces(1, bytes);
    const Result<void> written = co_await stream_->write(pieces);
    broken_ |= !written;
  }

  /// Nothing at the end of the connection, however it came; the peer leaves then.
  asio::awaitable<std::optional<Received>> receive() {
    const Result<std::optional<Frame>> frame = co_await read_frame(*stream_, buffer_);
    if (!frame || !frame->has_value()) {
      stream_->close();
      co_return std::nullopt;
    }
    Received received{(*frame)->header, {(*frame)->payload.begin(), (*frame)->payload.end()}};
    co_return received;
  }

  /// The next frame that is not Data, or nothing at the end; counts the Data bytes on the way.
  asio::awaitable<std::optional<Received>> receive_control() {
    for (;;) {
      std::optional<Received> frame = co_await receive();
      if (!frame || !frame->is(FrameType::Data)) co_return frame;
      data_bytes_ += frame->payload.size();
    }
  }

  void close() { stream_->close(); }
  bool broken() const { return broken_; }
  std::size_t data_bytes() const { return data_bytes_; }

 private:
  std::unique_ptr<ByteStream> stream_;
  FrameBuffer buffer_{kMaxPayload, 64u << 10};
  bool broken_ = false;
  std::size_t data_bytes_ = 0;
};

}  // namespace selvage::testing
