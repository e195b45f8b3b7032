// SPDX-License-Identifier: MIT
#include "server/encode/list_encoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/codec/decimals.h"
#include "common/codec/region_format.h"
#include "common/codec/value_lists.h"

namespace selvage {
namespace {

using Values = std::array<double, 3>;

/// Every magnitude once, ascending, and its signs.
struct Magnitudes {
  std::vector<double> values;
  std::vector<AxisSigns> signs;
};

Magnitudes collect_magnitudes(std::span<const Values> positions) {
  Magnitudes magnitudes;
  std::vector<double>& values = magnitudes.values;
  for (const Values& position : positions) {
    for (double value : position) values.push_back(std::abs(value));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  magnitudes.signs.resize(values.size());
  for (const Values& position : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto found = std::lower_bound(values.begin(), values.end(), std::abs(position[axis]));
      AxisSigns& signs = magnitudes.signs[static_cast<std::size_t>(found - values.begin())];
      signs[axis] |= std::signbit(position[axis]) ? 2 : 1;
    }
  }
  return magnitudes;
}

void encode_signs(std::span<const AxisSigns> all, EntropyEncoder& out) {
  SignContext context;
  for (const AxisSigns& signs : all) {
    for (unsigned axis = 0; axis < 3; ++axis) out.symbol(context.model(signs, axis), signs[axis]);
    context.add(signs);
  }
}

/// Strictly ascending numbers.
void encode_ascending(std::span<const std::uint32_t> numbers, unsigned gap_model, EntropyEncoder& out) {
  out.number(region_model::kListCount, static_cast<std::uint32_t>(numbers.size()));
  std::uint32_t lowest = 0;
  for (std::uint32_t number : numbers) {
    out.number(gap_model, number - lowest);
    lowest = number + 1;
  }
}

/// The rank of a float's magnitude if it is one of these decimals, else nothing.
bool find_rank(const Decimals& decimals, double magnitude, std::uint32_t& rank) {
  if (decimals.digits == 0) return false;
  const std::int64_t found = decimals.rank(magnitude);
  if (found > std::numeric_limits<std::int32_t>::max()) return false;
  rank = static_cast<std::uint32_t>(found);
  return double{decimals.value(found)} == magnitude;
}

std::uint32_t float_bits(double magnitude) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(magnitude));
}

/// Whatever codes a sample of the floats in the fewest bits.
Decimals choose_decimals(std::span<const double> magnitudes) {
  constexpr std::size_t kSamples = 256;
  constexpr double kException = 30;
  const auto count = static_cast<double>(magnitudes.size());
  const std::size_t step = magnitudes.size() / kSamples + 1;
  const auto cost_of = [&](const Decimals& decimals, double most) {
    double cost = 0, each = 0;
    std::uint32_t rank = 0;
    for (std::size_t i = 0; i < magnitudes.size() && cost < most; i += step) {
      if (find_rank(decimals, magnitudes[i], rank)) {
        each = std::max(each, std::log2(rank / count + 1));
      } else {
        cost += kException;
      }
    }
    return cost + each * count / static_cast<double>(step);
  };
  Decimals best;
  double least = std::log2(float_bits(magnitudes.back()) / count + 1) * count / static_cast<double>(step);
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    for (int places = 0; places <= kMostPlaces; ++places) {
      const double cost = cost_of({digits, places}, least);
      if (cost < least) least = cost, best = {digits, places};
    }
  }
  return best;
}

void encode_float_magnitudes(std::span<const double> magnitudes, EntropyEncoder& out) {
  const Decimals decimals = choose_decimals(magnitudes);
  out.symbol(region_model::kDigits, static_cast<unsigned>(decimals.digits));
  std::vector<std::uint32_t> ranks, bits;
  std::uint32_t rank = 0;
  for (double magnitude : magnitudes) {
    if (find_rank(decimals, magnitude, rank)) {
      ranks.push_back(rank);
    } else {
      bits.push_back(float_bits(magnitude));
    }
  }
  if (decimals.digits > 0) {
    out.symbol(region_model::kPlaces, static_cast<unsigned>(decimals.places));
    encode_ascending(ranks, region_model::kListGap, out);
  }
  encode_ascending(bits, region_model::kListFloatGap, out);
}

std::uint32_t place_of(const std::vector<double>& list, double value) {
  const auto found = std::lower_bound(list.begin(), list.end(), value);
  const bool is_behind_minus_zero = value == 0 && std::signbit(*found) != std::signbit(value);
  return static_cast<std::uint32_t>(found - list.begin()) + is_behind_minus_zero;
}

void encode_place(const PlaceWalk& walk, const Fan& fan, const PlaceWalk::Around& around, std::uint32_t place,
                  EntropyEncoder& out) {
  const PlaceWalk::Candidates candidates = walk.candidates(fan, around, PlaceWalk::kNoCandidate);
  const auto begin = candidates.places.begin(), end = begin + candidates.count;
  const auto found = std::find(begin, end, place);
  if (found != end) return out.symbol(around.model, static_cast<unsigned>(found - begin));
  out.symbol(around.model, PlaceWalk::kNoCandidate);
  const auto step = static_cast<std::int32_t>(place - walk.expected(fan, around));
  out.number(around.step_model, fold_sign(step) - 1);
}

// In step with decode_places of client/decode/list_decoder.cpp.
void encode_places(const FanTable& table, std::span<const Values> positions, const ValueLists& lists,
                   EntropyEncoder& out) {
  FanWalk::Memory memory;
  const auto vertices = static_cast<std::uint32_t>(positions.size());
  FanWalk order(table, vertices, memory);
  PlaceWalk walk(lists, vertices);
  Fan fan;
  for (const Values& position : positions) {
    order.turn();
    order.offer();
    order.gather(fan);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::uint32_t place = place_of(lists[axis], position[axis]);
      if (fan.neighbours == 0) {
        out.uniform(place, lists[axis].size());
        walk.place_first(axis, place);
        continue;
      }
      const PlaceWalk::Around around = walk.look_around(fan, axis);
      encode_place(walk, fan, around, place, out);
      walk.place(around, place);
    }
    walk.finish_vertex();
  }
}

template <class Position>
std::vector<Values> values_of(std::span<const Position> positions) {
  std::vector<Values> values;
  values.reserve(positions.size());
  for (const Position& p : positions)
    values.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  return values;
}

}  // namespace

void encode_listed_positions(const FanTable& table, std::span<const GridPoint> positions,
                             EntropyEncoder& out) {
  const std::vector<Values> values = values_of(positions);
  const Magnitudes magnitudes = collect_magnitudes(values);
  encode_ascending(std::vector<std::uint32_t>(magnitudes.values.begin(), magnitudes.values.end()),
                   region_model::kListGap, out);
  encode_signs(magnitudes.signs, out);
  encode_places(table, values, make_lists(magnitudes.values, magnitudes.signs), out);
}

void encode_listed_floats(const FanTable& table, std::span<const ExactPosition> exact, EntropyEncoder& out) {
  const std::vector<Values> values = values_of(exact);
  const Magnitudes magnitudes = collect_magnitudes(values);
  encode_float_magnitudes(magnitudes.values, out);
  encode_signs(magnitudes.signs, out);
  encode_places(table, values, make_lists(magnitudes.values, magnitudes.signs), out);
}

bool may_be_listed(std::span<const Triangle> triangles, std::span<const GridPoint> positions) {
  std::size_t alike = 0;
  for (const auto& [a, b, c] : triangles) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t at_a = positions[a][axis], at_b = positions[b][axis], at_c = positions[c][axis];
      alike += static_cast<unsigned>(at_a == at_b) + (at_b == at_c) + (at_c == at_a);
    }
  }
  // An eighth of nine.
  return 8 * alike >= 9 * triangles.size();
}

}  // namespace selvage
