// SPDX-License-Identifier: MIT
//
// Bytes in and out, little-endian, one at a time: no struct copies, no alignment, no host order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace selvage {

using Bytes = std::vector<std::byte>;

class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(std::byte{value}); }
  void u16(std::uint16_t value) { fixed(value, 2); }
  void u32(std::uint32_t value) { fixed(value, 4); }
  void u64(std::uint64_t value) { fixed(value, 8); }
  void f32(float value);
  void f64(double value);
  /// LEB128: 7 bits a byte, low first, the top bit says that more follow.
  void varint(std::uint64_t value);
  /// Small magnitudes of either sign become small varints: 0, -1, 1, -2 ... -> 0, 1, 2, 3 ...
  void signed_varint(std::int64_t value);
  void string(std::string_view text);  ///< varint length, then the bytes
  void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  std::size_t size() const { return bytes_.size(); }
  Bytes take() && { return std::move(bytes_); }

 private:
  void fixed(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  Bytes bytes_;
};

/// Reads hostile bytes. The first read past the end, overlong varint or unfulfilled demand makes the reader
/// fail for good: every later read gives zeros and empty spans, and `ok()` stays false. So a parser may read
/// a whole record and check once, as long as it checks before it trusts a count.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint8_t u8();
  std::uint16_t u16() { return static_cast<std::uint16_t>(fixed(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(fixed(4)); }
  std::uint64_t u64() { return fixed(8); }
  float f32();
  double f64();
  std::uint64_t varint();
  std::uint32_t varint32();  ///< fails beyond 32 bits
  std::int64_t signed_varint();
  std::string string(std::size_t max_length);
  std::span<const std::byte> take(std::uint64_t count);

  /// A count of things that take at least `min_bytes_each` of what is left; fails when they cannot fit, so a
  /// vector of that size may be reserved.
  std::uint32_t count(std::size_t min_bytes_each);

  bool ok() const { return ok_; }
  void set_failed() { ok_ = false; }
  std::size_t left() const { return ok_ ? bytes_.size() - at_ : 0; }
  std::size_t offset() const { return at_; }
  bool at_end() const { return ok_ && at_ == bytes_.size(); }

 private:
  std::uint64_t fixed(int count);

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace selvage
