// SPDX-License-Identifier: MIT
#include "common/coding/byte_io.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(ByteIo, RoundTripsEveryKind) {
  ByteWriter out;
  out.u16(0xABCD);
  out.f64(-0.0);
  out.string("né");
  for (std::uint64_t v :
       {std::uint64_t{0}, std::uint64_t{127}, std::uint64_t{128}, std::numeric_limits<std::uint64_t>::max()})
    out.varint(v);
  for (std::int64_t v : {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                         std::numeric_limits<std::int64_t>::max()})
    out.signed_varint(v);
  const Bytes bytes = std::move(out).take();
  ByteReader in(bytes);
  EXPECT_EQ(in.u16(), 0xABCD);
  EXPECT_TRUE(std::signbit(in.f64()));
  EXPECT_EQ(in.string(10), "né");
  for (std::uint64_t v :
       {std::uint64_t{0}, std::uint64_t{127}, std::uint64_t{128}, std::numeric_limits<std::uint64_t>::max()})
    EXPECT_EQ(in.varint(), v);
  for (std::int64_t v : {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                         std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(in.signed_varint(), v);
  EXPECT_TRUE(in.at_end());
}

TEST(ByteIo, StaysFailedAfterReadingPastTheEnd) {
  const Bytes bytes(3, std::byte{1});
  ByteReader in(bytes);
  EXPECT_EQ(in.u32(), 0u);
  EXPECT_FALSE(in.ok());
  EXPECT_EQ(in.u8(), 0u);
  EXPECT_EQ(in.left(), 0u);
}

TEST(ByteIo, RefusesOverlongAndOverflowingVarints) {
  const Bytes overlong = {std::byte{0x80}, std::byte{0x00}};
  ByteReader a(overlong);
  a.varint();
  EXPECT_FALSE(a.ok());
  const Bytes overflowing(10, std::byte{0xFF});
  ByteReader b(overflowing);
  b.varint();
  EXPECT_FALSE(b.ok());
}

TEST(ByteIo, RefusesACountThatTheBytesCannotBack) {
  ByteWriter out;
  out.varint(1000);
  const Bytes bytes = std::move(out).take();
  ByteReader in(bytes);
  EXPECT_EQ(in.count(1), 0u);
  EXPECT_FALSE(in.ok());
}

}  // namespace
}  // namespace selvage
