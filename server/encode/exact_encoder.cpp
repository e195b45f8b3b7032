// SPDX-License-Identifier: MIT
#include "server/encode/exact_encoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace selvage {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

/// The floats of one region.
struct Floats {
  std::span<const GridPoint> positions;
  std::span<const ExactPosition> exact;
  const Grid& grid;
};

/// The place of a float among the decimals of its cell, or cell.count if it is none of them.
std::uint64_t decimal_place(const Decimals& decimals, const RankCell& cell, float value) {
  const std::int64_t rank = decimals.rank(value);
  const auto place = static_cast<std::uint64_t>(rank - cell.first);
  return place < cell.count && bits_of(decimals.value(rank)) == bits_of(value) ? place : cell.count;
}

/// About the bits of one float in these decimals, and without.
double cost_in(const Decimals& decimals, const Floats& floats, std::size_t v, int axis) {
  constexpr double kEscape = 6;
  const std::int32_t coordinate = floats.positions[v][axis];
  if (decimals.digits > 0) {
    const RankCell cell = decimal_cell(decimals, floats.grid, axis, coordinate);
    if (decimal_place(decimals, cell, floats.exact[v][static_cast<std::size_t>(axis)]) < cell.count)
      return std::log2(static_cast<double>(cell.count));
  }
  const RankCell cell = float_cell(floats.grid, axis, coordinate);
  return std::log2(static_cast<double>(cell.count)) + (decimals.digits > 0 ? kEscape : 0);
}

/// Whatever codes a sample of the floats in the fewest bits.
Decimals choose_decimals(const Floats& floats) {
  constexpr std::size_t kSamples = 128;
  const std::size_t step = std::max<std::size_t>(1, floats.positions.size() / kSamples);
  const auto cost_of = [&](const Decimals& decimals, double most) {
    double cost = 0;
    for (std::size_t v = 0; v < floats.positions.size() && cost < most; v += step) {
      for (int axis = 0; axis < 3; ++axis) cost += cost_in(decimals, floats, v, axis);
    }
    return cost;
  };
  Decimals best;
  double least = cost_of(best, std::numeric_limits<double>::max());
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    for (int places = 0; places <= kMostPlaces; ++places) {
      const double cost = cost_of({digits, places}, least);
      if (cost < least) least = cost, best = {digits, places};
    }
  }
  return best;
}

// In step with decode_one of client/decode/exact_decoder.cpp.
void encode_one(EntropyEncoder& out, const Decimals& decimals, ExactAxis& axis, const Grid& grid, int which,
                std::int32_t coordinate, float value) {
  const auto [seen, is_new] = axis.seen.try_emplace(coordinate, value);
  const auto put = [&](ExactSymbol symbol) {
    out.symbol(axis.model(is_new), static_cast<unsigned>(symbol));
    axis.last_symbol = static_cast<unsigned>(symbol);
  };
  if (!is_new && bits_of(seen->second) == bits_of(value)) return put(ExactSymbol::Seen);
  seen->second = value;
  if (decimals.digits > 0) {
    const RankCell cell = decimal_cell(decimals, grid, which, coordinate);
    if (const std::uint64_t place = decimal_place(decimals, cell, value); place < cell.count) {
      put(ExactSymbol::Decimal);
      return out.uniform(place, cell.count);
    }
  }
  const RankCell cell = float_cell(grid, which, coordinate);
  const auto place = static_cast<std::uint64_t>(std::int64_t{float_rank(value)} - cell.first);
  if (place < cell.count) {
    put(ExactSymbol::Float);
    return out.uniform(place, cell.count);
  }
  put(ExactSymbol::Bits);
  out.bits(bits_of(value), 32);
}

}  // namespace

void encode_exact(std::span<const GridPoint> positions, std::span<const ExactPosition> exact,
                  const Grid& grid, EntropyEncoder& out) {
  const Decimals decimals = choose_decimals({positions, exact, grid});
  out.symbol(region_model::kDigits, static_cast<unsigned>(decimals.digits));
  if (decimals.digits > 0) out.symbol(region_model::kPlaces, static_cast<unsigned>(decimals.places));
  std::array<ExactAxis, 3> axes;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      encode_one(out, decimals, axes[a], grid, axis, positions[v][axis], exact[v][a]);
    }
  }
}

}  // namespace selvage
