// SPDX-License-Identifier: MIT
//
// Floats that were written as short decimals, which most meshes in text files are: numbers of at most
// `digits` significant digits and at most `places` behind the point, in the order of their values. They are
// to decimals what float_rank is to floats. A grid cell holds hundreds of floats, but often only a few
// decimals.
//
// Doubles, one operation at a time, each rounded to nearest: both sides find the same.
#pragma once

#include <cstdint>

namespace selvage {

struct Decimals {
  int digits = 0;  ///< 1..kMostDigits
  int places = 0;  ///< 0..kMostPlaces

  /// The rank of the decimal nearest to a finite number.
  std::int64_t rank(double number) const;
  /// The float nearest to the decimal of that rank, infinite if it is too large for one. Beyond the last rank
  /// there is, that one's.
  float value(std::int64_t rank) const;
};
inline constexpr int kMostDigits = 9, kMostPlaces = 15;

}  // namespace selvage
