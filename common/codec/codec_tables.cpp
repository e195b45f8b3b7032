// SPDX-License-Identifier: MIT
#include "common/codec/codec_tables.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace selvage {
namespace {

#include "common/codec/trained_tables.inc"  // made by bench/train

static_assert(std::all_of(kShapeWeights.begin(), kShapeWeights.end(), [](const ShapeWeights& w) {
  return std::max({w.beyond, w.ring, w.trend}) <= kMostShapeWeight &&
         std::min({w.beyond, w.ring, w.trend}) >= -kMostShapeWeight;
}));

constexpr unsigned kLevelsPerOctave = 12;
/// 2^(16 - i / 12), rounded.
constexpr std::array<std::uint32_t, kLevelsPerOctave> kLevelMantissa = {
    65536, 61858, 58386, 55109, 52016, 49097, 46341, 43740, 41285, 38968, 36781, 34716};

unsigned hex_digit(char c) { return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10); }

/// Two hex digits a byte: sixteen levels, uses, uses_limit.
PackedModel parse(std::string_view text) {
  PackedModel packed{};
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint8_t>(hex_digit(text[2 * i]) << 4 | hex_digit(text[2 * i + 1]));
  };
  for (std::size_t i = 0; i < kSymbols; ++i) packed.levels[i] = byte(i);
  packed.uses = byte(kSymbols);
  packed.uses_limit = byte(kSymbols + 1);
  return packed;
}

template <std::size_t N>
std::vector<StartModel> unpack_all(const std::array<std::string_view, N>& texts) {
  std::vector<StartModel> models;
  for (std::string_view text : texts) models.push_back(text.empty() ? fresh_model() : unpack(parse(text)));
  return models;
}

}  // namespace

StartModel unpack(const PackedModel& packed) {
  std::array<std::uint64_t, kSymbols> shares;
  std::uint64_t sum = 0;
  for (unsigned s = 0; s < kSymbols; ++s) {
    const unsigned level = packed.levels[s];
    shares[s] = std::uint64_t{kLevelMantissa[level % kLevelsPerOctave]} << 16 >> level / kLevelsPerOctave;
    sum += shares[s];
  }
  const auto likeliest =
      static_cast<unsigned>(std::max_element(shares.begin(), shares.end()) - shares.begin());
  std::array<std::uint32_t, kSymbols> frequencies;
  std::uint32_t left = kProbabilityOne;
  for (unsigned s = 0; s < kSymbols; ++s) {
    frequencies[s] = 1 + static_cast<std::uint32_t>(shares[s] * (kProbabilityOne - kSymbols) / sum);
    left -= frequencies[s];
  }
  frequencies[likeliest] += left;  // rounding
  StartModel model{};
  std::uint32_t at = 0;
  for (unsigned s = 0; s < kSymbols; ++s) {
    model.cumulative[s] = static_cast<std::uint16_t>(at);
    at += frequencies[s];
  }
  model.cumulative[kSymbols] = kProbabilityOne;
  model.uses = packed.uses;
  model.uses_limit = packed.uses_limit;
  return model;
}

const CodecTables& shipped_tables() {
  static const std::vector<StartModel> region = unpack_all(kRegionModels), bundle = unpack_all(kBundleModels);
  static const CodecTables tables{region, bundle, kShapeWeights, kSizeWeights};
  return tables;
}

std::string_view shipped_region_text(unsigned model) { return kRegionModels[model]; }

}  // namespace selvage
