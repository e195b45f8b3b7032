// SPDX-License-Identifier: MIT
#include "common/net/frame_io.h"

namespace selvage {

asio::awaitable<Result<std::optional<Frame>>> read_frame(ByteStream& stream, FrameBuffer& buffer) {
  for (;;) {
    Result<std::optional<Frame>> frame = buffer.take();
    if (!frame || frame->has_value()) co_return frame;
    const std::span<std::byte> room = buffer.writable();
    Result<std::size_t> count = co_await stream.read_some(room);
    if (!count) co_return forward_error(count);
    if (*count == 0) {
      if (buffer.between_frames()) co_return std::nullopt;
      co_return fail(ErrorCode::Io, "the connection ended in the middle of a frame");
    }
    buffer.commit(*count);
  }
}

}  // namespace selvage
