// SPDX-License-Identifier: MIT
#include "common/net/frame.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace selvage {
namespace {

using Bytes = std::vector<std::byte>;

Bytes frame_bytes(FrameHeader header, std::size_t payload_size) {
  header.length = static_cast<std::uint32_t>(payload_size);
  Bytes bytes(kFrameHeaderSize + payload_size);
  write_header(header, HeaderBytes(bytes.data(), kFrameHeaderSize));
  for (std::size_t i = 0; i < payload_size; ++i) bytes[kFrameHeaderSize + i] = static_cast<std::byte>(i);
  return bytes;
}

Result<FrameHeader> parse(const Bytes& bytes) {
  return parse_header(ConstHeaderBytes(bytes.data(), kFrameHeaderSize));
}

void feed(FrameBuffer& buffer, std::span<const std::byte> bytes) {
  const auto room = buffer.writable();
  ASSERT_LE(bytes.size(), room.size());
  std::ranges::copy(bytes, room.begin());
  buffer.commit(bytes.size());
}

TEST(Frame, HeaderIsLittleEndianInTheDocumentedOrder) {
  const Bytes bytes = frame_bytes({0, FrameType::Data, kFlagEnd, 0x01020304, 0x0A0B0C0D}, 0x0102);
  const std::array<int, kFrameHeaderSize> expected{2, 1, 0, 0, 9, 1, 0, 0, 4, 3, 2, 1, 0xD, 0xC, 0xB, 0xA};
  for (std::size_t i = 0; i < kFrameHeaderSize; ++i)
    EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << i;

  const auto header = parse(bytes);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->length, 0x0102u);
  EXPECT_EQ(header->type, FrameType::Data);
  EXPECT_EQ(header->flags, kFlagEnd);
  EXPECT_EQ(header->request_id, 0x01020304u);
  EXPECT_EQ(header->seq, 0x0A0B0C0Du);
}

TEST(Frame, RefusesUnknownTypesFlagsAndReservedBits) {
  for (int type : {0, kLastFrameType + 1, 255}) {
    Bytes bytes = frame_bytes({}, 0);
    bytes[4] = static_cast<std::byte>(type);
    EXPECT_EQ(parse(bytes).error().code, ErrorCode::Protocol) << type;
  }
  for (std::size_t at : {5, 6, 7}) {
    Bytes bytes = frame_bytes({}, 0);
    bytes[at] = std::byte{2};
    EXPECT_EQ(parse(bytes).error().code, ErrorCode::Protocol) << at;
  }
}

TEST(Frame, EveryTypeHasAName) {
  for (int type = 1; type <= kLastFrameType; ++type)
    EXPECT_NE(to_string(static_cast<FrameType>(type)), "Unknown");
}

TEST(Frame, RefusesALengthBeyondOneMebibyte) {
  Bytes bytes = frame_bytes({}, 0);
  bytes[2] = std::byte{0x10};
  EXPECT_TRUE(parse(bytes));
  bytes[0] = std::byte{1};
  EXPECT_EQ(parse(bytes).error().code, ErrorCode::Protocol);
}

TEST(FrameBuffer, GivesWholeFramesHoweverTheyArrive) {
  Bytes stream;
  for (std::uint32_t id = 1; id <= 5; ++id) {
    const Bytes bytes = frame_bytes({0, FrameType::Data, 0, id, 0}, 100 * id);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  for (std::size_t step = 1; step < 300; ++step) {
    FrameBuffer buffer(kMaxPayload, 64);
    std::uint32_t frames = 0;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size = std::min({step, stream.size() - at, buffer.writable().size()});
      feed(buffer, std::span(stream).subspan(at, size));
      at += size;
      for (auto frame = buffer.take(); frame->has_value(); frame = buffer.take()) {
        ++frames;
        EXPECT_EQ((*frame)->header.request_id, frames);
        ASSERT_EQ((*frame)->payload.size(), 100 * frames);
        EXPECT_EQ((*frame)->payload.back(), static_cast<std::byte>(100 * frames - 1));
      }
    }
    EXPECT_EQ(frames, 5u) << step;
    EXPECT_TRUE(buffer.between_frames());
  }
}

TEST(FrameBuffer, KnowsAnUnfinishedFrame) {
  FrameBuffer buffer(kMaxPayload, 64);
  const Bytes bytes = frame_bytes({}, 0);
  feed(buffer, std::span(bytes).first(3));
  EXPECT_FALSE(buffer.take()->has_value());
  EXPECT_FALSE(buffer.between_frames());
}

TEST(FrameBuffer, RefusesALongerFrameThanThisSideAcceptsBeforeMakingRoom) {
  FrameBuffer buffer(1000, 64);
  const Bytes bytes = frame_bytes({}, 1001);
  feed(buffer, std::span(bytes).first(kFrameHeaderSize));
  const auto frame = buffer.take();
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::Protocol);
  EXPECT_LE(buffer.writable().size(), 1000u);
}

}  // namespace
}  // namespace selvage
