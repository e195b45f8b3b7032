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

struct Ends {
  double low, high;
};
Ends ends_of_cell(const Grid& grid, int axis, std::int32_t coordinate) {
  return {grid.origin[axis] + (coordinate - 0.5) * grid.step,
          grid.origin[axis] + (coordinate + 0.5) * grid.step};
}

}  // namespace

std::uint32_t float_rank(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & kSignBit ? ~bits : bits | kSignBit;
}

float float_of_rank(std::uint32_t rank) {
  return std::bit_cast<float>(rank & kSignBit ? rank ^ kSignBit : ~rank);
}

RankCell float_cell(const Grid& grid, int axis, std::int32_t coordinate) {
  const auto [low, high] = ends_of_cell(grid, axis, coordinate);
  // Two more on each side for what rounding does on the way to the grid.
  const std::uint32_t first = rank_near(low) - 2, last = rank_near(high) + 2;
  return {first, std::uint64_t{last} - first + 1};
}

RankCell decimal_cell(const Decimals& decimals, const Grid& grid, int axis, std::int32_t coordinate) {
  const auto [low, high] = ends_of_cell(grid, axis, coordinate);
  const std::int64_t first = decimals.rank(low), last = decimals.rank(high);
  return {first, static_cast<std::uint64_t>(last - first) + 1};
}

}  // namespace selvage
