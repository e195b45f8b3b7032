// SPDX-License-Identifier: MIT
//
// Bit-exact positions: besides the grid point, which of the floats in its cell it was. Symbols, one an axis:
//
//   Seen    the same bits as the last vertex of this region at the same grid coordinate of this axis (CAD
//   models
//           repeat their coordinates)
//   InCell  the float's place among all floats of the cell, as if all were equally likely
//   Bits    32 bits; for what rounding put outside
//
// Cells are computed in IEEE doubles, one operation at a time, so that both sides find the same ends.
// Mirrors: server/encode/exact_encoder.cpp, client/decode/exact_decoder.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "common/mesh/grid.h"

namespace selvage {

using ExactPosition = std::array<float, 3>;

enum class ExactSymbol : std::uint8_t { Seen, InCell, Bits };
inline constexpr unsigned kExactSymbols = 3;

/// Floats in the order of their values, -0 just below 0; no NaN. Neighbours differ by 1.
std::uint32_t float_rank(float value);
float float_of_rank(std::uint32_t rank);

/// The floats that a grid coordinate may stand for: ranks first .. first + count - 1.
struct FloatCell {
  std::uint32_t first = 0;
  std::uint64_t count = 0;
};
FloatCell float_cell(const Grid& grid, int axis, std::int32_t coordinate);

/// One axis of a region: what was seen last at each grid coordinate, and the last symbol.
struct ExactAxis {
  std::unordered_map<std::int32_t, float> seen;
  unsigned last_symbol = 0;
};

}  // namespace selvage
