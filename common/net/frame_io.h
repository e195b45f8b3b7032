// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "common/net/byte_stream.h"
#include "common/net/frame.h"

namespace selvage {

/// The next frame of a stream; its payload lives in `buffer` until the next call. Nothing when the peer has
/// ended between two frames; Protocol on bad framing; Io when the connection breaks or ends inside a frame.
asio::awaitable<Result<std::optional<Frame>>> read_frame(ByteStream& stream, FrameBuffer& buffer);

}  // namespace selvage
