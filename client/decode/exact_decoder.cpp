// SPDX-License-Identifier: MIT
#include "client/decode/exact_decoder.h"

#include <bit>
#include <cmath>

#include "common/codec/codec_tables.h"

namespace selvage {
namespace {

std::uint64_t decode_uniform(EntropyDecoder& in, std::uint64_t count) {
  const int length = static_cast<int>(std::bit_width(count)) - 1;
  const std::uint64_t short_ones = (std::uint64_t{2} << length) - count;
  const std::uint64_t value = in.bits(length);
  return value < short_ones ? value : (value << 1 | in.bits(1)) - short_ones;
}

// In step with encode_one of server/encode/exact_encoder.cpp.
bool decode_one(EntropyDecoder& in, ExactAxis& axis, const FloatCell& cell, std::int32_t coordinate,
                float& value) {
  const auto [seen, is_new] = axis.seen.try_emplace(coordinate, 0.0f);
  const unsigned symbol = in.symbol(region_model::kExact + axis.last_symbol);
  if (symbol >= kExactSymbols) return false;
  axis.last_symbol = symbol;
  switch (static_cast<ExactSymbol>(symbol)) {
    case ExactSymbol::Seen:
      if (is_new) return false;
      value = seen->second;
      break;
    case ExactSymbol::InCell:
      value = float_of_rank(static_cast<std::uint32_t>(cell.first + decode_uniform(in, cell.count)));
      break;
    case ExactSymbol::Bits:
      value = std::bit_cast<float>(in.bits(32));
      break;
  }
  seen->second = value;
  return std::isfinite(value) && in.ok();
}

}  // namespace

Result<std::vector<ExactPosition>> decode_exact(std::span<const GridPoint> positions, const Grid& grid,
                                                EntropyDecoder& in) {
  std::array<ExactAxis, 3> axes;
  std::vector<ExactPosition> exact(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::int32_t coordinate = positions[v][axis];
      if (!decode_one(in, axes[a], float_cell(grid, axis, coordinate), coordinate, exact[v][a]))
        return fail(ErrorCode::BadStream, "region part: corrupt exact positions");
    }
  }
  return exact;
}

}  // namespace selvage
