// SPDX-License-Identifier: MIT
#include "common/codec/decimals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace selvage {
namespace {

/// Powers of ten that are exact in doubles.
constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
/// Below it lie the floats that matter; larger numbers all rank as the largest of it.
constexpr int kLowestPlaces = -22;

std::int64_t power(int exponent) {
  return static_cast<std::int64_t>(kPowers[static_cast<std::size_t>(exponent)]);
}

double scaled(double number, int places) {
  return places >= 0 ? number * kPowers[static_cast<std::size_t>(places)]
                     : number / kPowers[static_cast<std::size_t>(-places)];
}

}  // namespace

// Ranks 0 .. 10^digits - 1 have all the places; every place fewer adds what has exactly `digits` digits.
std::int64_t Decimals::rank(double number) const {
  const double magnitude = std::abs(number);
  const std::int64_t end = power(digits), decade = end - power(digits - 1);
  std::int64_t before = 0;
  int left = places;
  double count = std::floor(scaled(magnitude, left) + 0.5);
  while (count >= static_cast<double>(end) && left > kLowestPlaces) {
    before += decade;
    count = std::floor(scaled(magnitude, --left) + 0.5);
  }
  if (count >= static_cast<double>(end)) count = static_cast<double>(end - 1);
  const std::int64_t rank = before + static_cast<std::int64_t>(count);
  return number < 0 ? -rank : rank;
}

float Decimals::value(std::int64_t rank) const {
  const std::int64_t end = power(digits), decade = end - power(digits - 1);
  std::int64_t count = rank < 0 ? -rank : rank;
  int left = places;
  if (count >= end) {
    const std::int64_t most = places - kLowestPlaces, fewer = std::min((count - end) / decade + 1, most);
    count = std::min(count - fewer * decade, end - 1);
    left -= static_cast<int>(fewer);
  }
  const double magnitude = scaled(static_cast<double>(count), -left);
  return static_cast<float>(rank < 0 ? -magnitude : magnitude);
}

}  // namespace selvage
