// SPDX-License-Identifier: MIT
#include "common/coding/entropy_decoder.h"
#include "common/coding/entropy_encoder.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace selvage {
namespace {

struct Draw {
  unsigned symbol;
  std::uint32_t number;
  int bits;
};

std::vector<Draw> random_draws(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::geometric_distribution<unsigned> geometric(0.4);
  std::vector<Draw> draws;
  for (std::size_t i = 0; i < count; ++i) {
    const int bits = static_cast<int>(random() % 33);
    draws.push_back({std::min(geometric(random), 15u),
                     bits == 0 ? 0 : static_cast<std::uint32_t>(random() >> (32 - bits)), bits});
  }
  return draws;
}

template <int States>
Bytes encode(const std::vector<Draw>& draws) {
  EntropyEncoder out;
  AdaptiveModel<16> symbols;
  AdaptiveModel<33> numbers;
  for (const Draw& d : draws) {
    out.symbol(symbols, d.symbol);
    out.number(numbers, d.number);
    out.bits(d.number, d.bits);
  }
  return out.finish<States>();
}

template <int States>
void expect_round_trip(const std::vector<Draw>& draws) {
  const Bytes bytes = encode<States>(draws);
  EntropyDecoder<States> in(bytes);
  AdaptiveModel<16> symbols;
  AdaptiveModel<33> numbers;
  for (const Draw& d : draws) {
    ASSERT_EQ(in.symbol(symbols), d.symbol);
    ASSERT_EQ(in.number(numbers), d.number);
    ASSERT_EQ(in.bits(d.bits), d.number);
  }
  EXPECT_TRUE(in.is_finished());
}

TEST(EntropyCoder, RoundTripsSymbolsNumbersAndBits) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    expect_round_trip<1>(random_draws(seed, seed * seed * 10));
    expect_round_trip<2>(random_draws(seed, seed * seed * 10));
  }
}

TEST(EntropyCoder, ComesCloseToTheEntropyOfAStationarySource) {
  std::mt19937 random(1);
  std::discrete_distribution<unsigned> source({50, 25, 12, 6, 3, 2, 1, 1});
  double entropy = 0;
  for (double p : source.probabilities()) entropy -= p * std::log2(p);
  EntropyEncoder out;
  AdaptiveModel<16> model;
  constexpr int kSymbols = 20000;
  for (int i = 0; i < kSymbols; ++i) out.symbol(model, source(random));
  EXPECT_NEAR(static_cast<double>(out.finish<1>().size()) * 8 / kSymbols, entropy, 0.04);
}

TEST(EntropyCoder, NoticesEveryTruncation) {
  const auto draws = random_draws(3, 200);
  const Bytes bytes = encode<2>(draws);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes truncated(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EntropyDecoder<2> in(truncated);
    AdaptiveModel<16> symbols;
    AdaptiveModel<33> numbers;
    for (const Draw& d : draws) {
      in.symbol(symbols);
      in.number(numbers);
      in.bits(d.bits);
    }
    EXPECT_FALSE(in.is_finished()) << length;
  }
}

TEST(AdaptiveModel, KeepsEverySymbolPossible) {
  AdaptiveModel<16> model;
  for (int i = 0; i < 100000; ++i) model.update(7);
  std::uint32_t total = 0;
  for (unsigned s = 0; s < 16; ++s) {
    EXPECT_GE(model.range(s).frequency, 1u);
    EXPECT_EQ(model.range(s).start, total);
    total += model.range(s).frequency;
  }
  EXPECT_EQ(total, kProbabilityOne);
}

}  // namespace
}  // namespace selvage
