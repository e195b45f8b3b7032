// SPDX-License-Identifier: MIT
//
// The decoder half of entropy_encoder.h. Safe on hostile bytes: past the end it reads zeros and remembers it;
// every symbol it gives is within its model. How many symbols are read is the caller's to bound: a symbol may
// cost as little as 2^-15 bits (see kMaxSymbolsPerByte).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/coding/adaptive_model.h"

namespace selvage {

inline constexpr std::uint32_t kStateLow =
    1u << 16;  ///< states stay in [2^16, 2^32); they start here and end here

/// A byte backs at most this many symbols: the likeliest one leaves at least 2^-15 to the others.
inline constexpr std::uint64_t kMaxSymbolsPerByte = 8 << 15;

template <int States>
class EntropyDecoder {
 public:
  explicit EntropyDecoder(std::span<const std::byte> bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {
    for (std::uint32_t& state : states_) {
      const std::uint32_t high = word();
      state = high << 16 | word();
      if (state < kStateLow) overran_ = true, state = kStateLow;
    }
  }

  template <int N>
  unsigned symbol(AdaptiveModel<N>& model) {
    const std::uint32_t slot = states_[turn_] & (kProbabilityOne - 1);
    const unsigned symbol = model.find(slot);
    advance(model.range(symbol), slot);
    model.update(symbol);
    return symbol;
  }

  std::uint32_t bits(int count) {
    std::uint32_t value = 0;
    for (int done = 0; done < count;) {
      const int step = count - done < kRawBits ? count - done : kRawBits;
      const std::uint32_t slot = states_[turn_] & (kProbabilityOne - 1);
      const std::uint32_t piece = slot >> (kProbabilityBits - step);
      advance({piece << (kProbabilityBits - step), 1u << (kProbabilityBits - step)}, slot);
      value |= piece << done;
      done += step;
    }
    return value;
  }

  std::uint32_t number(AdaptiveModel<33>& length_model) {
    const auto length = static_cast<int>(symbol(length_model));
    return length < 2 ? static_cast<std::uint32_t>(length) : (1u << (length - 1)) + bits(length - 1);
  }

  /// False as soon as more was read than there is.
  bool ok() const { return !overran_; }

  /// True if every byte was consumed and the states are back where the encoder started: the stream was whole.
  bool is_finished() const {
    for (std::uint32_t state : states_) {
      if (state != kStateLow) return false;
    }
    return !overran_ && at_ == end_;
  }

 private:
  static constexpr int kRawBits = 12;

  std::uint32_t word() {
    if (end_ - at_ < 2) {
      overran_ = true;
      return 0;
    }
    const auto low = std::to_integer<std::uint32_t>(at_[0]), high = std::to_integer<std::uint32_t>(at_[1]);
    at_ += 2;
    return low | high << 8;
  }

  void advance(SymbolRange range, std::uint32_t slot) {
    std::uint32_t& state = states_[turn_];
    state = range.frequency * (state >> kProbabilityBits) + slot - range.start;
    if (state < kStateLow) state = state << 16 | word();
    turn_ = turn_ + 1 == States ? 0 : turn_ + 1;
  }

  const std::byte* at_;
  const std::byte* end_;
  std::array<std::uint32_t, States> states_{};
  int turn_ = 0;
  bool overran_ = false;
};

}  // namespace selvage
