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

constexpr unsigned kSymbolModel = 0, kLengthModel = 1;
std::vector<StartModel> two_models() { return {fresh_model(), fresh_model()}; }

Bytes encode(const std::vector<Draw>& draws) {
  EntropyEncoder out;
  for (const Draw& d : draws) {
    out.symbol(kSymbolModel, d.symbol);
    out.number(kLengthModel, d.number);
    out.bits(d.number, d.bits);
  }
  return out.finish(two_models()).bytes;
}

void expect_round_trip(const std::vector<Draw>& draws) {
  const Bytes bytes = encode(draws);
  const auto start = two_models();
  EntropyDecoder in(bytes, start);
  for (const Draw& d : draws) {
    ASSERT_EQ(in.symbol(kSymbolModel), d.symbol);
    ASSERT_EQ(in.number(kLengthModel), d.number);
    ASSERT_EQ(in.bits(d.bits), d.number);
  }
  EXPECT_TRUE(in.is_finished());
}

TEST(EntropyCoder, RoundTripsSymbolsNumbersAndBits) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    expect_round_trip(random_draws(seed, seed * seed * 10));
  }
}

TEST(EntropyCoder, ComesCloseToTheEntropyOfAStationarySource) {
  std::mt19937 random(1);
  std::discrete_distribution<unsigned> source({50, 25, 12, 6, 3, 2, 1, 1});
  double entropy = 0;
  for (double p : source.probabilities()) entropy -= p * std::log2(p);
  EntropyEncoder out;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) out.symbol(kSymbolModel, source(random));
  EXPECT_NEAR(static_cast<double>(out.finish(two_models()).bytes.size()) * 8 / kCount, entropy, 0.04);
}

// How many bits follow must not depend on bits, else a stream cut short may be another whole one.
TEST(EntropyCoder, NoticesEveryTruncation) {
  const auto draws = random_draws(3, 200);
  const auto start = two_models();
  EntropyEncoder out;
  for (const Draw& d : draws) {
    out.symbol(kSymbolModel, d.symbol);
    out.bits(d.number, d.bits);
  }
  const Bytes bytes = out.finish(start).bytes;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes truncated(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EntropyDecoder in(truncated, start);
    for (const Draw& d : draws) {
      in.symbol(kSymbolModel);
      in.bits(d.bits);
    }
    EXPECT_FALSE(in.is_finished()) << length;
  }
}

TEST(SymbolModels, KeepEverySymbolPossible) {
  for (unsigned seen = 0; seen < kSymbols; ++seen) {
    SymbolModels models(two_models());
    for (int i = 0; i < 10000; ++i) models.update(1, seen);
    std::uint32_t total = 0;
    for (unsigned s = 0; s < kSymbols; ++s) {
      EXPECT_GE(models.range(1, s).frequency, 1u);
      EXPECT_EQ(models.range(1, s).start, total);
      EXPECT_EQ(models.find(1, total), s);
      total += models.range(1, s).frequency;
      EXPECT_EQ(models.find(1, total - 1), s);
    }
    EXPECT_EQ(total, kProbabilityOne);
  }
}

}  // namespace
}  // namespace selvage
