// SPDX-License-Identifier: MIT
//
// The unit of the wire (docs/PROTOCOL.md, "Frames"): a header of 16 bytes and up to 1 MiB of payload.
//
//     u32 length | u8 type | u8 flags | u16 0 | u32 request_id | u32 seq        all little-endian
//
// Nothing here knows sockets or what payloads mean: FrameBuffer turns any sequence of received pieces into
// whole frames, and bad framing into an error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace selvage {

enum class FrameType : std::uint8_t {
  Hello = 1,
  HelloAck = 2,
  ListModels = 3,
  Models = 4,
  OpenModel = 5,
  ManifestBegin = 6,
  GetParts = 7,
  PartBegin = 8,
  Data = 9,
  RequestEnd = 10,
  Credit = 11,
  Cancel = 12,
  Reprioritise = 13,
  Error = 14,
  Ping = 15,
  Pong = 16,
  GoAway = 17,
  Publish = 18,
  PublishReady = 19,
  PublishProgress = 20,
  Published = 21,
  Unpublish = 22,
  Status = 23,
  StatusReport = 24,
};
inline constexpr std::uint8_t kLastFrameType = 24;

/// The enumerator's name, for logs and error messages.
std::string_view to_string(FrameType type);

inline constexpr std::size_t kFrameHeaderSize = 16;
inline constexpr std::uint32_t kMaxPayload = 1u << 20;
/// A part's or directory's bytes travel in Data frames of at most this many bytes.
inline constexpr std::uint32_t kMaxDataPayload = 256u << 10;
/// On the Data frame that completes a part or a directory.
inline constexpr std::uint8_t kFlagEnd = 1;

struct FrameHeader {
  std::uint32_t length = 0;  ///< of the payload
  FrameType type = FrameType::Ping;
  std::uint8_t flags = 0;
  std::uint32_t request_id = 0;  ///< 0: the connection itself
  std::uint32_t seq = 0;         ///< frames of this answer sent before this one; 0 in all that a client sends
};

using HeaderBytes = std::span<std::byte, kFrameHeaderSize>;
using ConstHeaderBytes = std::span<const std::byte, kFrameHeaderSize>;

void write_header(const FrameHeader& header, HeaderBytes out);

/// Protocol if the type or a flag is unknown, the reserved bytes are not 0 or the length is beyond
/// kMaxPayload.
Result<FrameHeader> parse_header(ConstHeaderBytes bytes);

struct Frame {
  FrameHeader header;
  std::span<const std::byte> payload;

  bool is(FrameType type) const { return header.type == type; }
  bool ends() const { return (header.flags & kFlagEnd) != 0; }
};

/// Received bytes, given back frame by frame. Holds at most one frame of the largest allowed size, or one
/// read's worth of smaller ones; the length in a header is checked before any room is made for it.
class FrameBuffer {
 public:
  /// `max_payload`: what this side accepts, at most kMaxPayload. `read_size`: how much one read should bring.
  FrameBuffer(std::uint32_t max_payload, std::size_t read_size);

  /// Where the next read may put bytes, once take() has nothing more; never empty. Invalidates payloads
  /// given.
  std::span<std::byte> writable();
  void commit(std::size_t count) { end_ += count; }

  /// The next whole frame, or nothing if more bytes are needed. The payload lives until the next writable().
  /// After an error the buffer is of no further use.
  Result<std::optional<Frame>> take();

  /// No bytes of an unfinished frame are held: the peer may end here.
  bool between_frames() const { return begin_ == end_; }
  /// Gives the room back until the next writable(); between frames only.
  void release() {
    bytes_ = {};
    begin_ = end_ = 0;
  }

 private:
  std::size_t wanted() const;

  std::vector<std::byte> bytes_;
  std::size_t begin_ = 0, end_ = 0;  ///< received and not yet taken
  std::uint32_t max_payload_;
  std::size_t read_size_;
  std::optional<FrameHeader> header_;  ///< of the frame at begin_, once it is whole
};

}  // namespace selvage
