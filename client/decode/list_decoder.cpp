// SPDX-License-Identifier: MIT
#include "client/decode/list_decoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "common/codec/decimals.h"
#include "common/codec/exact.h"
#include "common/codec/value_lists.h"

namespace selvage {
namespace {

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt value lists, ") + what);
}

/// Strictly ascending numbers below 2^31, each handed to `add`, which says whether it is sound. All lists of
/// a part together have at most as many as there are coordinates: `left` of them are not used up.
template <class Add>
bool decode_ascending(EntropyDecoder& in, unsigned gap_model, std::uint64_t& left, Add add) {
  const std::uint32_t count = in.number(region_model::kListCount);
  if (count > left) return false;
  left -= count;
  std::uint64_t lowest = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t number = lowest + in.number(gap_model);
    if (number >> 31 != 0 || !in.ok() || !add(static_cast<std::uint32_t>(number))) return false;
    lowest = number + 1;
  }
  return true;
}

bool decode_float_magnitudes(EntropyDecoder& in, std::uint64_t left, std::vector<double>& magnitudes) {
  Decimals decimals;
  decimals.digits = static_cast<int>(in.symbol(region_model::kDigits));
  if (decimals.digits > kMostDigits) return false;
  const auto add = [&](float value) {
    magnitudes.push_back(value);
    return std::isfinite(value);
  };
  if (decimals.digits > 0) {
    decimals.places = static_cast<int>(in.symbol(region_model::kPlaces));
    const auto add_rank = [&](std::uint32_t rank) { return add(decimals.value(rank)); };
    if (!decode_ascending(in, region_model::kListGap, left, add_rank)) return false;
  }
  const auto add_bits = [&](std::uint32_t bits) { return add(std::bit_cast<float>(bits)); };
  if (!decode_ascending(in, region_model::kListFloatGap, left, add_bits)) return false;
  std::sort(magnitudes.begin(), magnitudes.end());
  return true;
}

/// Every axis has a value, and all axes together have at most as many as there are coordinates.
bool decode_signs(EntropyDecoder& in, std::uint64_t most, std::vector<AxisSigns>& all) {
  SignContext context;
  std::array<std::uint64_t, 3> counts{};
  for (AxisSigns& signs : all) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned symbol = in.symbol(context.model(signs, axis));
      if (symbol > 3) return false;
      signs[axis] = static_cast<std::uint8_t>(symbol);
      counts[axis] += (symbol & 1) + (symbol >> 1);
    }
    context.add(signs);
  }
  return in.ok() && *std::min_element(counts.begin(), counts.end()) > 0 &&
         counts[0] + counts[1] + counts[2] <= most;
}

bool decode_lists(EntropyDecoder& in, std::uint32_t vertices, bool is_exact, ValueLists& lists) {
  const std::uint64_t most = 3 * std::uint64_t{vertices};
  std::uint64_t left = most;
  std::vector<double> magnitudes;
  const bool are_sound = is_exact ? decode_float_magnitudes(in, left, magnitudes)
                                  : decode_ascending(in, region_model::kListGap, left, [&](std::uint32_t x) {
                                      magnitudes.push_back(x);
                                      return true;
                                    });
  if (!are_sound) return false;
  std::vector<AxisSigns> signs(magnitudes.size());
  if (!decode_signs(in, most, signs)) return false;
  lists = make_lists(magnitudes, signs);
  return true;
}

bool decode_place(EntropyDecoder& in, const PlaceWalk& walk, const Fan& fan, const PlaceWalk::Around& around,
                  std::size_t count, std::uint32_t& place) {
  const unsigned symbol = in.symbol(around.model);
  if (symbol != PlaceWalk::kNoCandidate) {
    const PlaceWalk::Candidates candidates = walk.candidates(fan, around, symbol + 1);
    if (symbol >= candidates.count) return false;
    place = candidates.places[symbol];
    return true;
  }
  const std::uint64_t folded = std::uint64_t{in.number(around.step_model)} + 1;
  if (folded >> 32 != 0) return false;
  const std::int64_t found =
      std::int64_t{walk.expected(fan, around)} + unfold_sign(static_cast<std::uint32_t>(folded));
  place = static_cast<std::uint32_t>(found);
  return found >= 0 && static_cast<std::uint64_t>(found) < count;
}

/// Where the places lead to.
bool add_position(const std::array<double, 3>& values, const GridBox& box, const Grid* exact,
                  RegionMesh& mesh) {
  GridPoint position;
  if (exact != nullptr) {
    position = exact->quantise({values[0], values[1], values[2]});
    mesh.exact.push_back(
        {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])});
  } else {
    for (int axis = 0; axis < 3; ++axis)
      position[axis] = static_cast<std::int32_t>(values[static_cast<std::size_t>(axis)]);
  }
  mesh.positions.push_back(position);
  return box.holds(position);
}

// In step with encode_places of server/encode/list_encoder.cpp.
bool decode_places(EntropyDecoder& in, const ValueLists& lists, const GridBox& box, const Grid* exact,
                   FanWalk& order, std::uint32_t vertices, RegionMesh& mesh) {
  PlaceWalk walk(lists, vertices);
  mesh.positions.reserve(vertices);
  if (exact != nullptr) mesh.exact.reserve(vertices);
  for (Fan fan; order.turn();) {
    order.offer();
    order.gather(fan);
    std::array<double, 3> values;
    for (unsigned axis = 0; axis < 3; ++axis) {
      std::uint32_t place = 0;
      if (fan.neighbours == 0) {
        place = static_cast<std::uint32_t>(in.uniform(lists[axis].size()));
        walk.place_first(axis, place);
      } else {
        const PlaceWalk::Around around = walk.look_around(fan, axis);
        if (!decode_place(in, walk, fan, around, lists[axis].size(), place)) return false;
        walk.place(around, place);
      }
      values[axis] = lists[axis][place];
    }
    walk.finish_vertex();
    if (!add_position(values, box, exact, mesh) || !in.ok()) return false;
  }
  return order.is_complete() && order.count() == vertices;
}

}  // namespace

Result<void> decode_listed_positions(EntropyDecoder& in, const GridBox& box, std::uint32_t vertices,
                                     const Grid* exact, const FanTable& table, FanWalk::Memory& memory,
                                     RegionMesh& mesh) {
  ValueLists lists;
  if (!decode_lists(in, vertices, exact != nullptr, lists)) return corrupt("impossible values");
  FanWalk order(table, vertices, memory);
  if (!decode_places(in, lists, box, exact, order, vertices, mesh))
    return corrupt("impossible places, or not the promised vertices");
  mesh.triangles = order.triangles();
  mesh.loops = order.boundary_loops();
  return {};
}

}  // namespace selvage
