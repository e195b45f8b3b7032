// SPDX-License-Identifier: MIT
//
// The decoder half of entropy_encoder.h. Safe on hostile bytes: past the end it reads zeros and remembers it;
// every symbol it gives is within its model. How many symbols are read is the caller's to bound: a symbol may
// cost as little as 2^-15 bits (see kMaxSymbolsPerByte).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/coding/symbol_models.h"

namespace selvage {

/// States stay in [2^16, 2^32); the encoder's start here, so the decoder's end here.
inline constexpr std::uint32_t kStateLow = 1u << 16;

/// A byte backs at most this many symbols: the likeliest one leaves at least 2^-15 to each of the 15 others,
/// which costs 2^-15 * 15 / ln 2 bits.
inline constexpr std::uint64_t kMaxSymbolsPerByte = 8 << 11;

/// Bit lengths from here on take an escape and kLongNumberBits more bits.
inline constexpr int kLongNumber = 15;
inline constexpr int kLongNumberBits = 5;

template <int States>
class EntropyDecoder {
 public:
  EntropyDecoder(std::span<const std::byte> bytes, std::span<const StartModel> start)
      : models_(start),
        begin_(bytes.data()),
        at_(bytes.data()),
        end_(bytes.data() + bytes.size()),
        bits_at_(end_) {
    for (std::uint32_t& state : states_) {
      const std::uint32_t high = word();
      state = high << 16 | word();
      if (state < kStateLow) overran_ = true, state = kStateLow;
    }
  }

  unsigned symbol(unsigned model) {
    std::uint32_t& state = states_[turn_];
    if constexpr (States > 1) turn_ = turn_ + 1 == States ? 0 : turn_ + 1;
    const std::uint32_t slot = state & (kProbabilityOne - 1);
    const unsigned symbol = models_.find(model, slot);
    const SymbolRange range = models_.range(model, symbol);
    models_.update(model, symbol);
    state = range.frequency * (state >> kProbabilityBits) + slot - range.start;
    renormalise(state);
    return symbol;
  }

  /// A magnitude whose upper part is `coarse`, the `count` < 32 bits below it, and a sign unless all are 0.
  std::int32_t signed_bits(std::uint32_t coarse, int count) {
    if (filled_ <= count) refill();
    const auto low = static_cast<std::uint32_t>(buffer_) & ((1u << count) - 1);
    const auto magnitude = static_cast<std::int32_t>(coarse << count | low);
    const int has_sign = magnitude != 0;
    const auto sign = static_cast<std::int32_t>(buffer_ >> count) & has_sign;
    buffer_ >>= count + has_sign;
    filled_ -= count + has_sign;
    return (magnitude ^ -sign) + sign;
  }

  /// `count` <= 32.
  std::uint32_t bits(int count) {
    if (filled_ < count) refill();
    const auto value = static_cast<std::uint32_t>(buffer_ & ((std::uint64_t{1} << count) - 1));
    buffer_ >>= count;
    filled_ -= count;
    return value;
  }

  std::uint32_t number(unsigned length_model) {
    int length = static_cast<int>(symbol(length_model));
    if (length == kLongNumber) length += static_cast<int>(bits(kLongNumberBits));
    if (length > 32) overran_ = true, length = 0;
    return length < 2 ? static_cast<std::uint32_t>(length) : (1u << (length - 1)) + bits(length - 1);
  }

  /// False as soon as more was read than there is.
  bool ok() const { return !overran_; }

  /// True if every byte was consumed and the states are back where the encoder started: the stream was whole.
  bool is_finished() const {
    for (std::uint32_t state : states_) {
      if (state != kStateLow) return false;
    }
    // Whole bytes in the buffer were read ahead; the bits of a byte begun must be zero.
    const std::byte* used_to = bits_at_ + filled_ / 8;
    const std::uint64_t padding = buffer_ & ((std::uint64_t{1} << (filled_ % 8)) - 1);
    return !overran_ && padding == 0 && at_ == used_to;
  }

 private:
  /// Without a branch on the state, which is as good as random; the branch on what is left is not.
  void renormalise(std::uint32_t& state) {
    if (end_ - at_ < 2) {
      if (state < kStateLow) state = state << 16 | word();
      return;
    }
    const std::uint32_t next = std::to_integer<std::uint32_t>(at_[0]) | std::to_integer<std::uint32_t>(at_[1])
                                                                            << 8;
    const bool is_low = state < kStateLow;
    state = is_low ? state << 16 | next : state;
    at_ += is_low ? 2 : 0;
  }

  std::uint32_t word() {
    if (end_ - at_ < 2) {
      overran_ = true;
      return 0;
    }
    const auto low = std::to_integer<std::uint32_t>(at_[0]), high = std::to_integer<std::uint32_t>(at_[1]);
    at_ += 2;
    return low | high << 8;
  }

  /// At least 32 bits. Reading ahead may take bytes that are words' as well; is_finished() finds out.
  void refill() {
    if (bits_at_ - begin_ >= 4) {
      bits_at_ -= 4;
      std::uint64_t four = 0;
      for (int i = 0; i < 4; ++i) four |= std::to_integer<std::uint64_t>(bits_at_[i]) << (24 - 8 * i);
      buffer_ |= four << filled_;
      filled_ += 32;
      return;
    }
    while (filled_ < 32) {
      if (bits_at_ != begin_) {
        buffer_ |= std::to_integer<std::uint64_t>(*--bits_at_) << filled_;
      } else {
        overran_ = true;
      }
      filled_ += 8;
    }
  }

  SymbolModels models_;
  const std::byte *begin_, *at_, *end_, *bits_at_;
  std::array<std::uint32_t, States> states_{};
  int turn_ = 0;
  std::uint64_t buffer_ = 0;
  int filled_ = 0;
  bool overran_ = false;
};

}  // namespace selvage
