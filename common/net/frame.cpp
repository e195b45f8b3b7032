// SPDX-License-Identifier: MIT
#include "common/net/frame.h"

#include <algorithm>
#include <cstddef>

namespace selvage {
namespace {

void put_u32(std::byte* out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<std::byte>(value >> (8 * i));
}

std::uint32_t get_u32(const std::byte* in) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(in[i]) << (8 * i);
  return value;
}

}  // namespace

std::string_view to_string(FrameType type) {
  switch (type) {
    case FrameType::Hello:
      return "Hello";
    case FrameType::HelloAck:
      return "HelloAck";
    case FrameType::ListModels:
      return "ListModels";
    case FrameType::Models:
      return "Models";
    case FrameType::OpenModel:
      return "OpenModel";
    case FrameType::ManifestBegin:
      return "ManifestBegin";
    case FrameType::GetParts:
      return "GetParts";
    case FrameType::PartBegin:
      return "PartBegin";
    case FrameType::Data:
      return "Data";
    case FrameType::RequestEnd:
      return "RequestEnd";
    case FrameType::Credit:
      return "Credit";
    case FrameType::Cancel:
      return "Cancel";
    case FrameType::Reprioritise:
      return "Reprioritise";
    case FrameType::Error:
      return "Error";
    case FrameType::Ping:
      return "Ping";
    case FrameType::Pong:
      return "Pong";
    case FrameType::GoAway:
      return "GoAway";
    case FrameType::Publish:
      return "Publish";
    case FrameType::PublishReady:
      return "PublishReady";
    case FrameType::PublishProgress:
      return "PublishProgress";
    case FrameType::Published:
      return "Published";
    case FrameType::Unpublish:
      return "Unpublish";
    case FrameType::Status:
      return "Status";
    case FrameType::StatusReport:
      return "StatusReport";
  }
  return "Unknown";
}

void write_header(const FrameHeader& header, HeaderBytes out) {
  put_u32(&out[0], header.length);
  out[4] = static_cast<std::byte>(header.type);
  out[5] = std::byte{header.flags};
  out[6] = out[7] = std::byte{0};
  put_u32(&out[8], header.request_id);
  put_u32(&out[12], header.seq);
}

Result<FrameHeader> parse_header(ConstHeaderBytes bytes) {
  const auto type = std::to_integer<std::uint8_t>(bytes[4]);
  const auto flags = std::to_integer<std::uint8_t>(bytes[5]);
  const std::uint32_t length = get_u32(&bytes[0]);
  if (type == 0 || type > kLastFrameType) {
    return fail(ErrorCode::Protocol, "unknown frame type " + std::to_string(type));
  }
  if ((flags & ~kFlagEnd) != 0 || bytes[6] != std::byte{0} || bytes[7] != std::byte{0}) {
    return fail(ErrorCode::Protocol, "reserved bits of a frame header are set");
  }
  if (length > kMaxPayload) {
    return fail(ErrorCode::Protocol, "a frame of " + std::to_string(length) + " bytes is beyond 1 MiB");
  }
  return FrameHeader{length, static_cast<FrameType>(type), flags, get_u32(&bytes[8]), get_u32(&bytes[12])};
}

FrameBuffer::FrameBuffer(std::uint32_t max_payload, std::size_t read_size)
    : max_payload_(std::min(max_payload, kMaxPayload)), read_size_(std::max(read_size, kFrameHeaderSize)) {}

std::size_t FrameBuffer::wanted() const {
  const std::size_t whole = header_ ? kFrameHeaderSize + header_->length : kFrameHeaderSize;
  return std::max(whole, read_size_);
}

std::span<std::byte> FrameBuffer::writable() {
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
            bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
  end_ -= begin_;
  begin_ = 0;
  // take() left less than a whole frame, so `wanted` is more than what is held: there is room.
  bytes_.resize(wanted());
  if (bytes_.capacity() > 4 * bytes_.size()) bytes_.shrink_to_fit();  // a large frame has gone by
  return std::span(bytes_).subspan(end_);
}

Result<std::optional<Frame>> FrameBuffer::take() {
  if (!header_) {
    if (end_ - begin_ < kFrameHeaderSize) return std::nullopt;
    const auto parsed = parse_header(ConstHeaderBytes(&bytes_[begin_], kFrameHeaderSize));
    if (!parsed) return tl::unexpected(parsed.error());
    if (parsed->length > max_payload_) {
      return fail(ErrorCode::Protocol, "a frame of " + std::to_string(parsed->length) +
                                           " bytes is beyond this side's limit of " +
                                           std::to_string(max_payload_));
    }
    header_ = *parsed;
  }
  const std::size_t whole = kFrameHeaderSize + header_->length;
  if (end_ - begin_ < whole) return std::nullopt;
  Frame frame{*header_, std::span(bytes_).subspan(begin_ + kFrameHeaderSize, header_->length)};
  begin_ += whole;
  header_.reset();
  return frame;
}

}  // namespace selvage
