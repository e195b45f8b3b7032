// SPDX-License-Identifier: MIT
//
// A range coder [Martin 1979] over the same models as entropy_encoder.h, for parts of a few dozen bytes. It
// ends within a byte of the symbols' cost, where rANS leaves a state of 16 bits behind and rounds words and
// bits up on their own; it divides for every symbol, which such parts do not feel. Mirror: range_decoder.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/coding/byte_io.h"
#include "common/coding/symbol_models.h"

namespace selvage {

/// The width of the interval is kept above this by putting out bytes.
inline constexpr std::uint32_t kRangeLow = 1u << 24;
/// What one step may divide the interval by; greater choices take several.
inline constexpr std::uint32_t kMostChoices = 1u << 16;

/// Takes notes like EntropyEncoder, so that models may be chosen afterwards.
class RangeEncoder {
 public:
  void symbol(unsigned model, unsigned symbol) { tokens_.push_back({model, symbol}); }

  /// `value` < `count`, all equally likely. Takes log2(count) bits.
  void uniform(std::uint32_t value, std::uint32_t count);

  /// Any 32-bit number: its bit length through the model, the rest as bits.
  void number(unsigned length_model, std::uint32_t value);

  std::span<const Token> tokens() const { return tokens_; }
  /// What was coded without a model.
  double plain_bits() const;

  /// Codes everything noted, with models that begin as `start`. At least one byte; no other bytes decode to
  /// the same.
  Bytes finish(std::span<const StartModel> start) const;

 private:
  /// A choice that no model helps with, made before the token of that number.
  struct Plain {
    std::size_t before_token;
    std::uint32_t value, count;
  };
  std::vector<Token> tokens_;
  std::vector<Plain> plain_;
};

}  // namespace selvage
