// SPDX-License-Identifier: MIT
//
// Adaptive distributions that encoder and decoder keep in step: both start from the same tables and update
// them with the same integer arithmetic after every symbol.
//
// All models of a stream have 16 symbols, whatever they need, and lie side by side: one layout, one loop, and
// a start state that is copied in one go. An unused symbol costs 2^-15 of the range.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace selvage {

inline constexpr unsigned kSymbols = 16;
/// Probabilities are multiples of 2^-15.
inline constexpr int kProbabilityBits = 15;
inline constexpr std::uint32_t kProbabilityOne = 1u << kProbabilityBits;

/// A symbol yet to be coded: in training and statistics, what models are fed with.
struct Token {
  std::uint32_t model : 28;
  std::uint32_t symbol : 4;
};

/// A byte backs at most this many symbols: the likeliest one leaves at least 2^-15 to each of the 15 others,
/// which costs 2^-15 * 15 / ln 2 bits.
inline constexpr std::uint64_t kMaxSymbolsPerByte = 8 << 11;

/// Bit lengths from here on take an escape and kLongNumberBits more bits.
inline constexpr int kLongNumber = 15;
inline constexpr int kLongNumberBits = 5;

/// A symbol's share of [0, kProbabilityOne).
struct SymbolRange {
  std::uint32_t start = 0;
  std::uint32_t frequency = 0;
};

/// `cumulative[s]` is where symbol s starts, strictly rising from 0 to 2^15, where all end. `uses` is the
/// number of symbols that this state is worth: the next update moves by 2^-bit_width(uses). `uses_limit` is
/// where counting stops, so the last rate is 2^-bit_width(uses_limit); at most 255. Aligned for SIMD.
struct alignas(16) SymbolModel {
  std::uint16_t cumulative[kSymbols + 1];
  std::uint16_t uses, uses_limit;
};
/// A model before it is used.
using StartModel = SymbolModel;

/// Equally likely symbols and quick to learn.
StartModel fresh_model();

class SymbolModels {
 public:
  explicit SymbolModels(std::span<const StartModel> start) : models_(start.begin(), start.end()) {}

  std::size_t size() const { return models_.size(); }

  SymbolRange range(unsigned model, unsigned symbol) const {
    const std::uint16_t* c = models_[model].cumulative + symbol;
    return {c[0], static_cast<std::uint32_t>(c[1] - c[0])};
  }

  /// The symbol whose range holds `slot` < kProbabilityOne.
  unsigned find(unsigned model, std::uint32_t slot) const;

  /// Moves the model towards `symbol`.
  void update(unsigned model, unsigned symbol);

 private:
  std::vector<SymbolModel> models_;
};

/// Where a model moves to when a symbol was seen: all but one unit an entry of probability on that symbol.
/// Targets rise by at least 1 from entry to entry; so x + ((t - x + half) >> shift) keeps entries strictly
/// rising.
struct ModelTargets {
  alignas(32) std::int16_t of_symbol[kSymbols][kSymbols];
};
consteval ModelTargets make_model_targets() {
  ModelTargets targets{};
  for (unsigned symbol = 0; symbol < kSymbols; ++symbol) {
    for (unsigned i = 0; i < kSymbols; ++i)
      targets.of_symbol[symbol][i] =
          static_cast<std::int16_t>(i <= symbol ? i : kProbabilityOne - kSymbols + i);
  }
  return targets;
}
inline constexpr ModelTargets kModelTargets = make_model_targets();

/// How far a model moves after so many uses: by 2^-shift. Half of what the shift drops, in every lane, and
/// the shift as SIMD wants it.
struct MoveRate {
  alignas(16) std::int16_t half[8];
  alignas(16) std::int64_t shift[2];
};
inline constexpr auto kRateOfUses = [] {
  std::array<MoveRate, 256> rates{};
  for (unsigned uses = 0; uses < rates.size(); ++uses) {
    const int shift = static_cast<int>(std::bit_width(uses));
    for (std::int16_t& half : rates[uses].half) half = static_cast<std::int16_t>((1 << shift) / 2);
    rates[uses].shift[0] = shift;
  }
  return rates;
}();

#if defined(__SSE2__)

static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 16, "models are read sixteen bytes at a time");

/// What g++ lets alias the models' entries and nothing else, unlike __m128i.
using ShortLanes = std::int16_t __attribute__((vector_size(16)));

inline unsigned SymbolModels::find(unsigned model, std::uint32_t slot) const {
  const auto* c = reinterpret_cast<const ShortLanes*>(models_[model].cumulative);
  const __m128i at = _mm_set1_epi16(static_cast<short>(slot));
  const __m128i low = _mm_cmpgt_epi16((__m128i)c[0], at);
  const __m128i high = _mm_cmpgt_epi16((__m128i)c[1], at);
  const auto above = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
  return static_cast<unsigned>(std::countr_zero(above | 1u << kSymbols)) - 1;
}

inline void SymbolModels::update(unsigned model, unsigned symbol) {
  SymbolModel& moved = models_[model];
  const MoveRate& rate = kRateOfUses[moved.uses];
  auto* c = reinterpret_cast<ShortLanes*>(moved.cumulative);
  const auto* target = reinterpret_cast<const ShortLanes*>(kModelTargets.of_symbol[symbol]);
  const __m128i half = _mm_load_si128(reinterpret_cast<const __m128i*>(rate.half));
  const __m128i count = _mm_load_si128(reinterpret_cast<const __m128i*>(rate.shift));
  for (int i = 0; i < 2; ++i) {
    const auto old = (__m128i)c[i];
    const __m128i step = _mm_adds_epi16(_mm_sub_epi16((__m128i)target[i], old), half);
    c[i] = (ShortLanes)_mm_add_epi16(old, _mm_sra_epi16(step, count));
  }
  moved.uses = static_cast<std::uint16_t>(moved.uses + (moved.uses < moved.uses_limit));
}

#else

inline unsigned SymbolModels::find(unsigned model, std::uint32_t slot) const {
  const std::uint16_t* c = models_[model].cumulative;
  unsigned symbol = 0;
  for (unsigned i = 1; i < kSymbols; ++i) symbol += c[i] <= slot;
  return symbol;
}

inline void SymbolModels::update(unsigned model, unsigned symbol) {
  SymbolModel& moved = models_[model];
  const MoveRate& rate = kRateOfUses[moved.uses];
  std::uint16_t* c = moved.cumulative;
  for (unsigned i = 0; i < kSymbols; ++i) {
    // Saturated at 16 bits signed, as SIMD adds; entries stay strictly rising either way.
    int step = kModelTargets.of_symbol[symbol][i] - c[i] + rate.half[0];
    if (step > 32767) step = 32767;
    c[i] = static_cast<std::uint16_t>(c[i] + (step >> rate.shift[0]));
  }
  moved.uses = static_cast<std::uint16_t>(moved.uses + (moved.uses < moved.uses_limit));
}

#endif

}  // namespace selvage
