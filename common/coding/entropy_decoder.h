// SPDX-License-Identifier: MIT
//
// The decoder half of entropy_encoder.h. Safe on hostile bytes: past the end it reads zeros and remembers it;
// every symbol it gives is within its model. How many symbols are read is the caller's to bound: a symbol may
// cost as little as 2^-15 bits (see kMaxSymbolsPerByte).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "common/coding/symbol_models.h"

namespace selvage {

/// The state stays in [2^16, 2^32); the encoder's starts here, so the decoder's ends here.
inline constexpr std::uint32_t kStateLow = 1u << 16;

class EntropyDecoder {
 public:
  EntropyDecoder(std::span<const std::byte> bytes, std::span<const StartModel> start)
      : models_(start),
        begin_(bytes.data()),
        at_(bytes.data()),
        end_(bytes.data() + bytes.size()),
        words_end_(bytes.empty() ? end_ : end_ - 1),
        bits_at_(end_) {
    const std::uint32_t high = word();
    state_ = high << 16 | word();
    if (state_ < kStateLow) overran_ = true, state_ = kStateLow;
  }

  unsigned symbol(unsigned model) {
    const std::uint32_t slot = state_ & (kProbabilityOne - 1);
    const unsigned symbol = models_.find(model, slot);
    const SymbolRange range = models_.range(model, symbol);
    models_.update(model, symbol);
    state_ = range.frequency * (state_ >> kProbabilityBits) + slot - range.start;
    renormalise();
    return symbol;
  }

  /// Makes sure that bits_at_hand() may take `count` bits; up to 32 can be made sure of.
  void expect_bits(int count) {
    if (filled_ < count) refill();
  }
  /// The next `count` < 32 of the bits that were made sure of.
  std::uint32_t bits_at_hand(int count) {
    const auto value = static_cast<std::uint32_t>(buffer_) & ((1u << count) - 1);
    buffer_ >>= count;
    filled_ -= count;
    return value;
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
  bool ok() const { return !overran_ && filled_ >= invented_; }

  /// True if every byte was consumed and the states are back where the encoder started: the stream was whole.
  bool is_finished() const {
    // Whole bytes in the buffer were read ahead; the bits of a byte begun must be zero.
    const std::byte* used_to = bits_at_ + (filled_ - invented_) / 8;
    const std::uint64_t padding = buffer_ & ((std::uint64_t{1} << (filled_ % 8)) - 1);
    return ok() && state_ == kStateLow && padding == 0 && at_ == used_to;
  }

 private:
  /// Without a branch on the state, which is as good as random; the branch on what is left is not.
  void renormalise() {
    if (at_ >= words_end_) [[unlikely]] {
      if (state_ < kStateLow) state_ = state_ << 16 | word();
      return;
    }
    const std::uint32_t refilled = state_ << 16 | word_at(at_);
    at_ += state_ < kStateLow ? 2 : 0;
    state_ = state_ < kStateLow ? refilled : state_;
  }

  static std::uint32_t word_at(const std::byte* at) {
    return std::to_integer<std::uint32_t>(at[0]) | std::to_integer<std::uint32_t>(at[1]) << 8;
  }

  std::uint32_t word() {
    if (end_ - at_ < 2) {
      overran_ = true;
      return 0;
    }
    at_ += 2;
    return word_at(at_ - 2);
  }

  /// At least 32 bits. Reading ahead may take bytes that are words' as well; is_finished() finds out.
  void refill() {
    if (bits_at_ - begin_ >= 4) {
      bits_at_ -= 4;
      std::uint32_t four = 0;
      for (int i = 0; i < 4; ++i) four |= std::to_integer<std::uint32_t>(bits_at_[i]) << (24 - 8 * i);
      buffer_ |= std::uint64_t{four} << filled_;
      filled_ += 32;
      return;
    }
    while (filled_ < 32) {
      if (bits_at_ != begin_) {
        buffer_ |= std::to_integer<std::uint64_t>(*--bits_at_) << filled_;
      } else {
        invented_ = std::min(invented_ + 8, 1 << 20);
      }
      filled_ += 8;
    }
  }

  SymbolModels models_;
  const std::byte *begin_, *at_, *end_;
  const std::byte* words_end_;  ///< no whole word begins here or later
  const std::byte* bits_at_;
  std::uint32_t state_ = kStateLow;
  std::uint64_t buffer_ = 0;
  int filled_ = 0;
  int invented_ = 0;  ///< zero bits from before the first byte: bad if more were taken than those behind them
  bool overran_ = false;
};

}  // namespace selvage
