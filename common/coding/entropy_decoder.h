// SPDX-License-Identifier: MIT
//
// The decoder half of entropy_encoder.h. Safe on hostile bytes: past the end it reads zeros and remembers it;
// every symbol it gives is within its model. How many symbols are read is the caller's to bound: a symbol may
// cost as little as 2^-15 bits (see kMaxSymbolsPerByte).
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "common/coding/symbol_models.h"

namespace selvage {

/// The state stays in [2^16, 2^48); the encoder's starts here, so the decoder's ends here.
inline constexpr std::uint64_t kStateLow = 1u << 16;
/// So much of the state is moved at once when it leaves that range, and so much is written of the last one.
inline constexpr int kWordBits = 32, kLastStateBits = 48;

class EntropyDecoder {
 public:
  EntropyDecoder(std::span<const std::byte> bytes, std::span<const StartModel> start)
      : models_(start), begin_(bytes.data()), at_(bytes.data()), end_(bytes.data() + bytes.size()) {
    state_ = take(kLastStateBits / 8);
    if (state_ < kStateLow) overran_ = true, state_ = kStateLow;
  }

  unsigned symbol(unsigned model) {
    const auto slot = static_cast<std::uint32_t>(state_) & (kProbabilityOne - 1);
    const unsigned symbol = models_.find(model, slot);
    const SymbolRange range = models_.range(model, symbol);
    models_.update(model, symbol);
    state_ = range.frequency * (state_ >> kProbabilityBits) + slot - range.start;
    // Once in some fifteen symbols: a branch costs less than doing without.
    if (state_ < kStateLow) [[unlikely]]
      state_ = state_ << kWordBits | take(kWordBits / 8);
    return symbol;
  }

  /// The next kPeek bits and perhaps some more, lowest first; zeros past the end.
  std::uint64_t peek_bits() const {
    const std::size_t bytes = bits_used_ / 8, left = static_cast<std::size_t>(end_ - begin_);
    if (left < bytes + sizeof(std::uint64_t)) [[unlikely]]
      return peek_last_bits();
    std::uint64_t backwards;
    std::memcpy(&backwards, end_ - bytes - sizeof backwards, sizeof backwards);
    if constexpr (std::endian::native == std::endian::little) backwards = __builtin_bswap64(backwards);
    return backwards >> bits_used_ % 8;
  }
  static constexpr int kPeek = 57;
  void skip_bits(int count) { bits_used_ += static_cast<std::size_t>(count); }

  /// `count` <= 32.
  std::uint32_t bits(int count) {
    const auto value = static_cast<std::uint32_t>(peek_bits() & ((std::uint64_t{1} << count) - 1));
    skip_bits(count);
    return value;
  }

  /// Below `count` <= 2^32.
  std::uint64_t uniform(std::uint64_t count) {
    const int length = static_cast<int>(std::bit_width(count)) - 1;
    const std::uint64_t short_ones = (std::uint64_t{2} << length) - count;
    const std::uint64_t value = bits(length);
    return value < short_ones ? value : (value << 1 | bits(1)) - short_ones;
  }

  std::uint32_t number(unsigned length_model) {
    int length = static_cast<int>(symbol(length_model));
    if (length == kLongNumber) length += static_cast<int>(bits(kLongNumberBits));
    if (length > 32) overran_ = true, length = 0;
    return length < 2 ? static_cast<std::uint32_t>(length) : (1u << (length - 1)) + bits(length - 1);
  }

  /// False as soon as more was read than there is.
  bool ok() const { return !overran_ && bits_used_ <= 8 * static_cast<std::size_t>(end_ - begin_); }

  /// True if every byte was consumed and the states are back where the encoder started: the stream was whole.
  bool is_finished() const {
    if (!ok() || state_ != kStateLow || at_ != end_ - (bits_used_ + 7) / 8) return false;
    // The bits of a byte begun must be zero.
    return bits_used_ % 8 == 0 || (peek_bits() & ((1u << (8 - bits_used_ % 8)) - 1)) == 0;
  }

 private:
  /// Little-endian.
  std::uint64_t take(int bytes) {
    if (end_ - at_ < bytes) {
      overran_ = true;
      return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::to_integer<std::uint64_t>(*at_++) << (8 * i);
    return value;
  }

  std::uint64_t peek_last_bits() const {
    std::uint64_t value = 0;
    const std::size_t bytes = bits_used_ / 8, size = static_cast<std::size_t>(end_ - begin_);
    for (std::size_t i = 0; i < sizeof value && bytes + i < size; ++i)
      value |= std::to_integer<std::uint64_t>(end_[-1 - static_cast<std::ptrdiff_t>(bytes + i)]) << (8 * i);
    return value >> bits_used_ % 8;
  }

  SymbolModels models_;
  const std::byte *begin_, *at_, *end_;
  std::uint64_t state_ = kStateLow;
  std::size_t bits_used_ = 0;  ///< counted from the last byte backwards
  bool overran_ = false;
};

}  // namespace selvage
