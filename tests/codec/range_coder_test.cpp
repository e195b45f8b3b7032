// SPDX-License-Identifier: MIT
#include "common/coding/range_decoder.h"
#include "common/coding/range_encoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace selvage {
namespace {

constexpr unsigned kSymbolModel = 0, kLengthModel = 1;
std::vector<StartModel> two_models() { return {fresh_model(), fresh_model()}; }

struct Draw {
  unsigned symbol;
  std::uint32_t number;
  std::uint32_t value, count;
};

std::vector<Draw> random_draws(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::geometric_distribution<unsigned> geometric(0.4);
  std::vector<Draw> draws;
  for (std::size_t i = 0; i < count; ++i) {
    Draw draw{std::min(geometric(random), 15u), static_cast<std::uint32_t>(random() >> random() % 32), 0,
              static_cast<std::uint32_t>(random() >> random() % 32)};
    draw.count = std::max(draw.count, 1u);
    draw.value = random() % 4 == 0 ? draw.count - 1 : static_cast<std::uint32_t>(random()) % draw.count;
    draws.push_back(draw);
  }
  return draws;
}

Bytes encode(const std::vector<Draw>& draws) {
  RangeEncoder out;
  for (const Draw& d : draws) {
    out.symbol(kSymbolModel, d.symbol);
    out.uniform(d.value, d.count);
    out.number(kLengthModel, d.number);
  }
  return out.finish(two_models());
}

/// What the bytes hold where `draws` were coded; nothing if they are not what an encoder writes.
bool decodes(std::span<const std::byte> bytes, std::vector<Draw>& draws) {
  const auto start = two_models();
  RangeDecoder in(bytes, start);
  for (Draw& d : draws) {
    d.symbol = in.symbol(kSymbolModel);
    d.value = in.uniform(d.count);
    d.number = in.number(kLengthModel);
  }
  return in.is_finished();
}

bool operator==(const Draw& a, const Draw& b) {
  return a.symbol == b.symbol && a.number == b.number && a.value == b.value;
}

TEST(RangeCoder, RoundTripsSymbolsNumbersAndChoices) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const auto draws = random_draws(seed, seed % 50);
    auto decoded = draws;
    ASSERT_TRUE(decodes(encode(draws), decoded)) << seed;
    EXPECT_TRUE(decoded == draws) << seed;
  }
}

TEST(RangeCoder, EndsWithinAByteOfTheCost) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    RangeEncoder out;
    for (std::uint32_t i = 0; i < seed; ++i) out.symbol(kSymbolModel, random() % 3);
    out.uniform(random() % 1000, 1000);
    const auto start = two_models();
    SymbolModels models(start);
    double bits = out.plain_bits();
    for (const Token& token : out.tokens()) {
      bits += kProbabilityBits - std::log2(models.range(token.model, token.symbol).frequency);
      models.update(token.model, token.symbol);
    }
    EXPECT_LE(static_cast<double>(out.finish(start).size()), bits / 8 + 1.05) << seed;
  }
}

// An interval that ends on high bytes of 255 carries far up when it moves.
TEST(RangeCoder, CarriesThroughBytesThatAreOut) {
  for (std::uint32_t last = 0; last < 200; ++last) {
    RangeEncoder out;
    for (int i = 0; i < 12; ++i) out.uniform(last == 0 ? 65535 : 65535 - i % last, 65536);
    for (int i = 0; i < 8; ++i) out.uniform(last, 200);
    const Bytes bytes = out.finish({});
    RangeDecoder in(bytes, {});
    for (std::uint32_t i = 0; i < 12; ++i) ASSERT_EQ(in.uniform(65536), last == 0 ? 65535 : 65535 - i % last);
    for (int i = 0; i < 8; ++i) ASSERT_EQ(in.uniform(200), last);
    EXPECT_TRUE(in.is_finished());
  }
}

TEST(RangeCoder, GivesNoTwoStreamsForTheSameSymbols) {
  std::mt19937 random(1);
  int whole = 0;
  for (int round = 0; round < 200000; ++round) {
    Bytes bytes(1 + random() % 4);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    std::vector<Draw> draws(round % 3, Draw{0, 0, 0, 1 + static_cast<std::uint32_t>(random() % 300)});
    if (!decodes(bytes, draws)) continue;
    ++whole;
    ASSERT_EQ(encode(draws), bytes);
  }
  EXPECT_GT(whole, 100);
}

TEST(RangeCoder, RefusesExtraBytes) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    auto draws = random_draws(seed, seed);
    Bytes bytes = encode(draws);
    for (int extra = 0; extra < 6; ++extra) {
      bytes.push_back(std::byte{0});
      EXPECT_FALSE(decodes(bytes, draws)) << seed;
    }
  }
}

}  // namespace
}  // namespace selvage
