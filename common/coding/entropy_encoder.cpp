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

  std::uint64_t state = kStateLow;
  std::vector<std::uint32_t> words;  // in the order of coding, which is the reverse of the order of reading
  words.reserve(ranges.size() / 8 + 2);
  std::size_t words_behind_mark = 0;
  for (std::size_t i = ranges.size(); i-- > 0;) {
    if (i + 1 == mark_) words_behind_mark = words.size();
    const std::uint32_t begin = ranges[i] >> 16, frequency = ranges[i] & 0xFFFF;
    // From here on the state would not stay below 2^48. One word out is always enough.
    if ((state >> (kLastStateBits - kProbabilityBits)) >= frequency) {
      words.push_back(static_cast<std::uint32_t>(state));
      state >>= kWordBits;
    }
    state = (state / frequency << kProbabilityBits) + state % frequency + begin;
  }

  Coded coded;
  Bytes& out = coded.bytes;
  const auto put = [&](std::uint64_t value, int bits) {
    for (int shift = 0; shift < bits; shift += 8) out.push_back(static_cast<std::byte>(value >> shift));
  };
  constexpr std::size_t kWordBytes = kWordBits / 8, kStateBytes = kLastStateBits / 8;
  if (mark_ > 0) coded.bytes_to_mark = kStateBytes + kWordBytes * (words.size() - words_behind_mark);
  out.reserve(kStateBytes + kWordBytes * words.size() + raw_.size() + 1);
  put(state, kLastStateBits);
  for (auto word = words.rbegin(); word != words.rend(); ++word) put(*word, kWordBits);
  if (filled_ > 0) out.push_back(static_cast<std::byte>(buffer_));
  out.insert(out.end(), raw_.rbegin(), raw_.rend());
  return coded;
}

}  // namespace selvage
