// SPDX-License-Identifier: MIT
//
// Range asymmetric numeral systems [Duda 2014], 32-bit states, 16-bit renormalisation. rANS decodes last-in
// first-out, so the encoder records ranges while models adapt forwards and codes them backwards in finish().
// Mirror: entropy_decoder.h.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "common/coding/adaptive_model.h"
#include "common/coding/byte_io.h"

namespace selvage {

class EntropyEncoder {
 public:
  template <int N>
  void symbol(AdaptiveModel<N>& model, unsigned symbol) {
    record(model.range(symbol));
    model.update(symbol);
  }

  /// `count` <= 32 bits without a model.
  void bits(std::uint32_t value, int count) {
    for (; count > kRawBits; count -= kRawBits) {
      raw(value & ((1u << kRawBits) - 1), kRawBits);
      value >>= kRawBits;
    }
    if (count > 0) raw(value, count);
  }

  /// Any 32-bit number: its bit length through the model, the rest raw. Cheap for whatever range prevails.
  void number(AdaptiveModel<33>& length_model, std::uint32_t value) {
    const int length = std::bit_width(value);
    symbol(length_model, static_cast<unsigned>(length));
    if (length > 1) bits(value - (1u << (length - 1)), length - 1);
  }

  /// Codes everything recorded. `States` interleaved states (1 for short streams, 2 where speed counts) cost
  /// two bytes each; the decoder must be made for the same number.
  template <int States>
  Bytes finish() const;

 private:
  static constexpr int kRawBits = 12;

  void record(SymbolRange range) { ranges_.push_back(range.start << 16 | range.frequency); }
  void raw(std::uint32_t value, int count) {
    record({value << (kProbabilityBits - count), 1u << (kProbabilityBits - count)});
  }

  std::vector<std::uint32_t> ranges_;  ///< start in the high half, frequency in the low one
};

extern template Bytes EntropyEncoder::finish<1>() const;
extern template Bytes EntropyEncoder::finish<2>() const;

}  // namespace selvage
