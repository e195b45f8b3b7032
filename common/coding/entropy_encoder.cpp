// SPDX-License-Identifier: MIT
#include "common/coding/entropy_encoder.h"

#include <algorithm>
#include <array>

#include "common/coding/entropy_decoder.h"

namespace selvage {

template <int States>
Bytes EntropyEncoder::finish() const {
  std::array<std::uint32_t, States> states;
  states.fill(kStateLow);
  std::vector<std::uint16_t> words;  // in the order of coding, which is the reverse of the order of reading
  words.reserve(ranges_.size() / 4 + 2 * States);
  for (std::size_t i = ranges_.size(); i-- > 0;) {
    const std::uint32_t start = ranges_[i] >> 16, frequency = ranges_[i] & 0xFFFF;
    std::uint32_t& state = states[i % States];
    // The largest state that `frequency` still fits below 2^32: one word out is always enough.
    if ((state >> 17) >= frequency) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16;
    }
    state = (state / frequency << kProbabilityBits) + state % frequency + start;
  }
  for (int s = States; s-- > 0;) {
    words.push_back(static_cast<std::uint16_t>(states[s]));
    words.push_back(static_cast<std::uint16_t>(states[s] >> 16));
  }
  std::reverse(words.begin(), words.end());
  ByteWriter out;
  for (std::uint16_t word : words) out.u16(word);
  return std::move(out).take();
}

template Bytes EntropyEncoder::finish<1>() const;
template Bytes EntropyEncoder::finish<2>() const;

}  // namespace selvage
