// SPDX-License-Identifier: MIT
#include "common/coding/byte_io.h"

#include <bit>

namespace selvage {

void ByteWriter::f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
void ByteWriter::f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }

void ByteWriter::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) u8(static_cast<std::uint8_t>(value | 0x80));
  u8(static_cast<std::uint8_t>(value));
}

void ByteWriter::signed_varint(std::int64_t value) {
  varint((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
}

void ByteWriter::string(std::string_view text) {
  varint(text.size());
  append(std::as_bytes(std::span(text.data(), text.size())));
}

std::uint8_t ByteReader::u8() {
  if (left() == 0) {
    ok_ = false;
    return 0;
  }
  return std::to_integer<std::uint8_t>(bytes_[at_++]);
}

std::uint64_t ByteReader::fixed(int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= std::uint64_t{u8()} << (8 * i);
  return ok_ ? value : 0;
}

float ByteReader::f32() { return std::bit_cast<float>(u32()); }
double ByteReader::f64() { return std::bit_cast<double>(u64()); }

std::uint64_t ByteReader::varint() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const std::uint8_t byte = u8();
    if (!ok_) return 0;
    const std::uint64_t payload = byte & 0x7F;
    // The tenth byte holds one bit. An overlong form (a trailing zero byte) would give one value two
    // spellings.
    if ((shift == 63 && payload > 1) || (byte == 0 && shift > 0)) break;
    value |= payload << shift;
    if ((byte & 0x80) == 0) return value;
  }
  ok_ = false;
  return 0;
}

std::uint32_t ByteReader::varint32() {
  const std::uint64_t value = varint();
  if (value > 0xFFFFFFFFu) ok_ = false;
  return ok_ ? static_cast<std::uint32_t>(value) : 0;
}

std::int64_t ByteReader::signed_varint() {
  const std::uint64_t value = varint();
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

std::string ByteReader::string(std::size_t max_length) {
  const std::uint64_t length = varint();
  if (length > max_length) ok_ = false;
  const auto bytes = take(length);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::span<const std::byte> ByteReader::take(std::uint64_t count) {
  if (count > left()) ok_ = false;
  if (!ok_) return {};
  const auto taken = bytes_.subspan(at_, count);
  at_ += count;
  return taken;
}

std::uint32_t ByteReader::count(std::size_t min_bytes_each) {
  const std::uint32_t value = varint32();
  if (value > left() / min_bytes_each) ok_ = false;
  return ok_ ? value : 0;
}

}  // namespace selvage
