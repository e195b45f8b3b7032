// SPDX-License-Identifier: MIT
#include "client/decode/exact_decoder.h"

#include <bit>
#include <cmath>

namespace selvage {
namespace {

// In step with encode_one of server/encode/exact_encoder.cpp.
bool decode_one(EntropyDecoder& in, const Decimals& decimals, ExactAxis& axis, const Grid& grid, int which,
                std::int32_t coordinate, float& value) {
  const auto [seen, is_new] = axis.seen.try_emplace(coordinate, 0.0f);
  const unsigned symbol = in.symbol(axis.model(is_new));
  if (symbol >= kExactSymbols) return false;
  axis.last_symbol = symbol;
  switch (static_cast<ExactSymbol>(symbol)) {
    case ExactSymbol::Seen:
      if (is_new) return false;
      value = seen->second;
      break;
    case ExactSymbol::Decimal: {
      if (decimals.digits == 0) return false;
      const RankCell cell = decimal_cell(decimals, grid, which, coordinate);
      value = decimals.value(cell.first + static_cast<std::int64_t>(in.uniform(cell.count)));
      break;
    }
    case ExactSymbol::Float: {
      const RankCell cell = float_cell(grid, which, coordinate);
      const auto place = static_cast<std::int64_t>(in.uniform(cell.count));
      value = float_of_rank(static_cast<std::uint32_t>(cell.first + place));
      break;
    }
    case ExactSymbol::Bits:
      value = std::bit_cast<float>(in.bits(32));
      break;
  }
  seen->second = value;
  return std::isfinite(value) && in.ok();
}

bool decode_decimals(EntropyDecoder& in, Decimals& decimals) {
  decimals.digits = static_cast<int>(in.symbol(region_model::kDigits));
  if (decimals.digits > 0) decimals.places = static_cast<int>(in.symbol(region_model::kPlaces));
  return decimals.digits <= kMostDigits && in.ok();
}

}  // namespace

Result<std::vector<ExactPosition>> decode_exact(std::span<const GridPoint> positions, const Grid& grid,
                                                EntropyDecoder& in) {
  const auto corrupt = [] { return fail(ErrorCode::BadStream, "region part: corrupt exact positions"); };
  Decimals decimals;
  if (!decode_decimals(in, decimals)) return corrupt();
  std::array<ExactAxis, 3> axes;
  std::vector<ExactPosition> exact(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (!decode_one(in, decimals, axes[a], grid, axis, positions[v][axis], exact[v][a])) return corrupt();
    }
  }
  return exact;
}

}  // namespace selvage
