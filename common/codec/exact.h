// SPDX-License-Identifier: MIT
//
// Bit-exact positions: besides the grid point, which of the floats in its cell it was. Symbols, one an axis:
//
//   Seen     the same bits as the last vertex of this region at the same grid coordinate of this axis (CAD
//            models repeat their coordinates)
//   Decimal  the place among the decimals of the cell, where the region says how long they are
//   Float    the place among all floats of the cell
//   Bits     32 bits; for what rounding put outside
//
// Places are coded as if all were equally likely.
//
// Cells are computed in IEEE doubles, one operation at a time, so that both sides find the same ends.
// Mirrors: server/encode/exact_encoder.cpp, client/decode/exact_decoder.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "common/codec/codec_tables.h"
#include "common/codec/decimals.h"
#include "common/mesh/grid.h"

namespace selvage {

using ExactPosition = std::array<float, 3>;

enum class ExactSymbol : std::uint8_t { Seen, Decimal, Float, Bits };
inline constexpr unsigned kExactSymbols = 4;

/// Floats in the order of their values, -0 just below 0; no NaN. Neighbours differ by 1.
std::uint32_t float_rank(float value);
float float_of_rank(std::uint32_t rank);

/// What a grid coordinate may stand for: ranks first .. first + count - 1, of floats or of decimals.
struct RankCell {
  std::int64_t first = 0;
  std::uint64_t count = 0;
};
RankCell float_cell(const Grid& grid, int axis, std::int32_t coordinate);
RankCell decimal_cell(const Decimals& decimals, const Grid& grid, int axis, std::int32_t coordinate);

/// One axis of a region: what was seen last at each grid coordinate, and the last symbol.
struct ExactAxis {
  std::unordered_map<std::int32_t, float> seen;
  unsigned last_symbol = 0;

  unsigned model(bool is_new) const {
    return (is_new ? region_model::kExactNew : region_model::kExact) + last_symbol;
  }
};

}  // namespace selvage
