// SPDX-License-Identifier: MIT
//
// Range asymmetric numeral systems [Duda 2014], a 48-bit state, 32-bit renormalisation, for symbols; plain
// bits for what no model helps with. One span holds both: words from its front, bits from its back.
//
//   | words of the state, forwards  --> | <-- bits, backwards |
//
// rANS decodes last-in first-out, so the encoder only takes notes and does the work in finish(). Mirror:
// entropy_decoder.h.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "common/coding/byte_io.h"
#include "common/coding/symbol_models.h"

namespace selvage {

class EntropyEncoder {
 public:
  void symbol(unsigned model, unsigned symbol) { tokens_.push_back({model, symbol}); }

  /// `count` <= 32 bits without a model; `value` < 2^count.
  void bits(std::uint32_t value, int count) {
    buffer_ |= std::uint64_t{value} << filled_;
    filled_ += count;
    bit_count_ += static_cast<std::uint64_t>(count);
    for (; filled_ >= 8; filled_ -= 8, buffer_ >>= 8) raw_.push_back(static_cast<std::byte>(buffer_));
  }

  /// `value` < `count` <= 2^32, all equally likely: one of two lengths where `count` is no power of two.
  void uniform(std::uint64_t value, std::uint64_t count) {
    const int length = static_cast<int>(std::bit_width(count)) - 1;
    const std::uint64_t short_ones = (std::uint64_t{2} << length) - count;
    if (value < short_ones) return bits(static_cast<std::uint32_t>(value), length);
    const std::uint64_t shifted = value + short_ones;
    bits(static_cast<std::uint32_t>(shifted >> 1), length);
    bits(static_cast<std::uint32_t>(shifted & 1), 1);
  }

  /// Any 32-bit number: its bit length through the model (15 and more escape), the rest as bits. Cheap for
  /// whatever range prevails.
  void number(unsigned length_model, std::uint32_t value);

  std::span<const Token> tokens() const { return tokens_; }
  /// What was coded without a model.
  double plain_bits() const { return static_cast<double>(bit_count_); }

  /// Remembers this place: finish() tells how many bytes come before it.
  void mark() { mark_ = tokens_.size(); }

  struct Coded {
    Bytes bytes;
    std::size_t bytes_to_mark = 0;  ///< of symbols, give or take a few
  };
  /// Codes everything noted, with models that begin as `start`.
  Coded finish(std::span<const StartModel> start) const;

 private:
  std::vector<Token> tokens_;
  std::vector<std::byte> raw_;
  std::uint64_t buffer_ = 0;
  int filled_ = 0;
  std::uint64_t bit_count_ = 0;
  std::size_t mark_ = 0;
};

}  // namespace selvage
