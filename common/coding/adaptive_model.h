// SPDX-License-Identifier: MIT
//
// Adaptive distributions that encoder and decoder keep in step: both start from the same state and update it
// with the same integer arithmetic after every symbol.
#pragma once

#include <array>
#include <cstdint>

namespace selvage {

/// Probabilities are multiples of 2^-15.
inline constexpr int kProbabilityBits = 15;
inline constexpr std::uint32_t kProbabilityOne = 1u << kProbabilityBits;

/// A symbol's share of [0, kProbabilityOne).
struct SymbolRange {
  std::uint32_t start = 0;
  std::uint32_t frequency = 0;
};

/// A distribution over `N` symbols as a cumulative table that moves a fixed share of the way towards the
/// symbol just seen. The share shrinks with use (1/8 at first, 1/256 in the end), so a fresh context learns
/// quickly and a seasoned one is precise. Every symbol keeps a frequency of at least 1: targets rise by 1
/// from entry to entry, and x + ((t - x) >> s) then keeps neighbours apart.
template <int N>
class AdaptiveModel {
 public:
  AdaptiveModel() {
    for (int i = 0; i <= N; ++i) cumulative_[i] = static_cast<std::uint16_t>(kProbabilityOne * i / N);
  }

  SymbolRange range(unsigned symbol) const {
    return {cumulative_[symbol], static_cast<std::uint32_t>(cumulative_[symbol + 1] - cumulative_[symbol])};
  }

  /// The symbol whose range holds `slot` < kProbabilityOne. Counting instead of searching lets the compiler
  /// vectorise.
  unsigned find(std::uint32_t slot) const {
    unsigned below = 0;
    for (int i = 1; i < N; ++i) below += cumulative_[i] <= slot;
    return below;
  }

  void update(unsigned symbol) {
    const int shift = shift_after(uses_);
    for (int i = 1; i < N; ++i) {
      const int target = i + (static_cast<unsigned>(i) > symbol ? static_cast<int>(kProbabilityOne) - N : 0);
      cumulative_[i] = static_cast<std::uint16_t>(cumulative_[i] + ((target - cumulative_[i]) >> shift));
    }
    if (uses_ < kSeasoned) ++uses_;
  }

 private:
  static constexpr std::uint8_t kSeasoned = 200;
  static int shift_after(std::uint8_t uses) {
    return uses < 4 ? 3 : uses < 12 ? 4 : uses < 28 ? 5 : uses < 72 ? 6 : uses < kSeasoned ? 7 : 8;
  }

  std::array<std::uint16_t, N + 1> cumulative_;
  std::uint8_t uses_ = 0;
};

}  // namespace selvage
