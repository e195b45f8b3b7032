// SPDX-License-Identifier: MIT
#include "server/encode/exact_encoder.h"

#include <bit>

#include "common/codec/codec_tables.h"

namespace selvage {
namespace {

/// `value` < count, in the shorter of two lengths where count is no power of two.
void encode_uniform(EntropyEncoder& out, std::uint64_t value, std::uint64_t count) {
  const int length = static_cast<int>(std::bit_width(count)) - 1;
  const std::uint64_t short_ones = (std::uint64_t{2} << length) - count;
  if (value < short_ones) return out.bits(static_cast<std::uint32_t>(value), length);
  const std::uint64_t shifted = value + short_ones;
  out.bits(static_cast<std::uint32_t>(shifted >> 1), length);
  out.bits(static_cast<std::uint32_t>(shifted & 1), 1);
}

// In step with decode_one of client/decode/exact_decoder.cpp.
void encode_one(EntropyEncoder& out, ExactAxis& axis, const FloatCell& cell, std::int32_t coordinate,
                float value) {
  const auto [seen, is_new] = axis.seen.try_emplace(coordinate, value);
  const std::uint64_t place = std::uint64_t{float_rank(value)} - cell.first;
  ExactSymbol symbol = place < cell.count ? ExactSymbol::InCell : ExactSymbol::Bits;
  if (!is_new && float_rank(seen->second) == float_rank(value)) symbol = ExactSymbol::Seen;
  out.symbol(region_model::kExact + axis.last_symbol, static_cast<unsigned>(symbol));
  axis.last_symbol = static_cast<unsigned>(symbol);
  if (symbol == ExactSymbol::InCell) encode_uniform(out, place, cell.count);
  if (symbol == ExactSymbol::Bits) out.bits(std::bit_cast<std::uint32_t>(value), 32);
  seen->second = value;
}

}  // namespace

void encode_exact(std::span<const GridPoint> positions, std::span<const ExactPosition> exact,
                  const Grid& grid, EntropyEncoder& out) {
  std::array<ExactAxis, 3> axes;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::int32_t coordinate = positions[v][axis];
      encode_one(out, axes[a], float_cell(grid, axis, coordinate), coordinate, exact[v][a]);
    }
  }
}

}  // namespace selvage
