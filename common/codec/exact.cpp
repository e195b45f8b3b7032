// SPDX-License-Identifier: MIT
#include "common/codec/exact.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace selvage {
namespace {

constexpr std::uint32_t kSignBit = 1u << 31;

std::uint32_t rank_near(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return float_rank(static_cast<float>(std::clamp(value, -kMost, kMost)));
}

}  // namespace

std::uint32_t float_rank(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & kSignBit ? ~bits : bits | kSignBit;
}

float float_of_rank(std::uint32_t rank) {
  return std::bit_cast<float>(rank & kSignBit ? rank ^ kSignBit : ~rank);
}

FloatCell float_cell(const Grid& grid, int axis, std::int32_t coordinate) {
  const double low = grid.origin[axis] + (coordinate - 0.5) * grid.step;
  const double high = grid.origin[axis] + (coordinate + 0.5) * grid.step;
  // Two more on each side for what rounding does on the way to the grid.
  const std::uint32_t first = rank_near(low) - 2, last = rank_near(high) + 2;
  return {first, std::uint64_t{last} - first + 1};
}

}  // namespace selvage
