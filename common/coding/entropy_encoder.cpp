// SPDX-License-Identifier: MIT
#include "common/coding/entropy_encoder.h"

#include <algorithm>
#include <array>
#include <bit>

#include "common/coding/entropy_decoder.h"

namespace selvage {

void EntropyEncoder::number(unsigned length_model, std::uint32_t value) {
  const int length = std::bit_width(value);
  symbol(length_model, static_cast<unsigned>(std::min(length, kLongNumber)));
  if (length >= kLongNumber) bits(static_cast<std::uint32_t>(length - kLongNumber), kLongNumberBits);
  if (length > 1) bits(value - (1u << (length - 1)), length - 1);
}

EntropyEncoder::Coded EntropyEncoder::finish(std::span<const StartModel> start) const {
  SymbolModels models(start);
  std::vector<std::uint32_t> ranges;  // start in the high half, frequency in the low one
  ranges.reserve(tokens_.size());
  for (const Token& token : tokens_) {
    const SymbolRange range = models.range(token.model, token.symbol);
    models.update(token.model, token.symbol);
    ranges.push_back(range.start << 16 | range.frequency);
  }

  std::uint32_t state = kStateLow;
  std::vector<std::uint16_t> words;  // in the order of coding, which is the reverse of the order of reading
  words.reserve(ranges.size() / 4 + 2);
  std::size_t words_behind_mark = 0;
  for (std::size_t i = ranges.size(); i-- > 0;) {
    if (i + 1 == mark_) words_behind_mark = words.size();
    const std::uint32_t begin = ranges[i] >> 16, frequency = ranges[i] & 0xFFFF;
    // The largest state that `frequency` still fits below 2^32: one word out is always enough.
    if ((state >> 17) >= frequency) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16;
    }
    state = (state / frequency << kProbabilityBits) + state % frequency + begin;
  }
  words.push_back(static_cast<std::uint16_t>(state));
  words.push_back(static_cast<std::uint16_t>(state >> 16));

  Coded coded;
  if (mark_ > 0) coded.bytes_to_mark = 2 * (words.size() - words_behind_mark);
  Bytes& out = coded.bytes;
  out.reserve(2 * words.size() + raw_.size() + 1);
  for (auto word = words.rbegin(); word != words.rend(); ++word) {
    out.push_back(static_cast<std::byte>(*word));
    out.push_back(static_cast<std::byte>(*word >> 8));
  }
  if (filled_ > 0) out.push_back(static_cast<std::byte>(buffer_));
  out.insert(out.end(), raw_.rbegin(), raw_.rend());
  return coded;
}

}  // namespace selvage
