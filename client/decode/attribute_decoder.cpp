// SPDX-License-Identifier: MIT
#include "client/decode/attribute_decoder.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace selvage {
namespace {

using Decoder = EntropyDecoder;

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt attributes, ") + what);
}

/// The part of a magnitude above its low bits. What no encoder writes becomes kMaxResidual.
inline std::uint32_t decode_coarse(Decoder& in, unsigned symbol, const SizeClass& size) {
  if (symbol != kMagnitudeEscape) [[likely]]
    return symbol;
  const std::uint32_t excess = std::min(in.number(region_model::kExcess), kMaxResidual);
  return std::min(symbol + excess, kMaxResidual >> size.raw_low_bits);
}

/// A residual and the number of its raw bits: a sign unless it must be 0, then the low bits.
struct Residual {
  std::int32_t magnitude, value;
  int bits;
  /// The model told `coarse`; the bits are the lowest ones of `window`.
  Residual(std::uint32_t coarse, int low_bits, std::uint64_t window)
      : bits(low_bits + ((coarse | static_cast<unsigned>(low_bits)) != 0)) {
    // The sign is the lowest bit; without low bits and magnitude it is another's, and 0 has none.
    const std::uint32_t whole =
        coarse << 1 << low_bits | (static_cast<std::uint32_t>(window) & ((2u << low_bits) - 1));
    magnitude = static_cast<std::int32_t>(whole >> 1);
    const auto sign = static_cast<std::int32_t>(whole & 1);
    value = (magnitude ^ -sign) + sign;
  }
};

/// The box in lanes.
struct LaneBox {
  IntLanes low, high;
  explicit LaneBox(const GridBox& box)
      : low{box.low.x, box.low.y, box.low.z, 0}, high{box.high.x, box.high.y, box.high.z, 0} {}
  /// Negative in those of the first three lanes that lie outside.
  IntLanes outside(IntLanes v) const { return (v - low) | (high - v); }
};

bool decode_blends(Decoder& in, Blends& blends) {
  blends.shape = in.symbol(region_model::kShape);
  blends.trend = in.symbol(region_model::kTrend);
  blends.tangent = in.symbol(region_model::kTangent);
  return blends.shape <= Blends::kMax && blends.trend <= Blends::kMax &&
         blends.tangent <= Blends::kMaxTangent;
}

bool decode_offset(Decoder& in, const GridBox& box, GridPoint& position) {
  for (int axis = 0; axis < 3; ++axis)
    position[axis] = box.low[axis] + static_cast<std::int32_t>(in.bits(box.offset_bits(axis)));
  return box.holds(position) && in.ok();
}

/// x, y, z of a residual along the normal axis and the two after it.
IntLanes along_axes(unsigned normal_axis, std::int32_t n, std::int32_t u, std::int32_t w) {
  static constexpr IntLanes kLanes[3] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}};
  const IntLanes first = kLanes[normal_axis], second = __builtin_shufflevector(first, first, 2, 0, 1, 3),
                 third = __builtin_shufflevector(first, first, 1, 2, 0, 3);
  return (first & n) | (second & u) | (third & w);
}

/// A position that something predicts. One outside the box leaves its mark in `outside`.
void decode_position(Decoder& in, const Predictor& predictor, const Surroundings& around, const LaneBox& box,
                     GeometryWalk& walk, IntLanes& outside) {
  const IntLanes expected = predictor.expected_sizes(around);
  walk.work_ahead<0>();
  const SizeClass first = predictor.size_class(around, expected, 0, 0, 0);
  const unsigned symbol_u = in.symbol(magnitude_model(0, around, first));
  const std::uint32_t coarse_u = decode_coarse(in, symbol_u, first);
  const std::int32_t log_u = coarse_log(symbol_u, first);
  walk.work_ahead<1>();
  const SizeClass second = predictor.size_class(around, expected, 1, log_u, 0);
  const unsigned symbol_w = in.symbol(magnitude_model(1, around, second));
  const std::uint32_t coarse_w = decode_coarse(in, symbol_w, second);
  const std::int32_t log_w = coarse_log(symbol_w, second);
  walk.work_ahead<2>();
  const SizeClass third = predictor.size_class(around, expected, 2, log_u, log_w);
  const unsigned symbol_last = in.symbol(magnitude_model(2, around, third));
  const std::uint32_t coarse_last = decode_coarse(in, symbol_last, third);
  static_assert(EntropyDecoder::kPeek >= 3 * kMostResidualBits);
  std::uint64_t window = in.peek_bits();
  const Residual u(coarse_u, first.raw_low_bits, window);
  const Residual w(coarse_w, second.raw_low_bits, window >>= u.bits);
  const Residual last(coarse_last, third.raw_low_bits, window >>= w.bits);
  in.skip_bits(u.bits + w.bits + last.bits);
  const std::int32_t tangent = predictor.tangent_residual(around, u.value, w.value);
  const IntLanes position =
      predictor.predict(around) + along_axes(around.normal_axis, last.value + tangent, u.value, w.value);
  outside |= box.outside(position);
  walk.place(around, position, static_cast<std::uint32_t>(u.magnitude + w.magnitude),
             static_cast<std::uint32_t>(last.magnitude));
}

std::vector<bool> decode_turned(Decoder& in, std::uint32_t triangles) {
  std::vector<bool> is_turned(triangles);
  bool before = false;
  for (TriangleId t = 0; t < triangles; ++t)
    is_turned[t] = before = in.symbol(region_model::kTurned + before) != 0;
  return is_turned;
}

bool decode_anchors(Decoder& in, RegionMesh& mesh) {
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.vertex_count());
  const std::uint32_t count = in.number(region_model::kAnchorCount);
  if (count > order.size() || count == 0) return false;
  std::uint64_t next_place = 0;
  std::uint32_t next_group = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t place = next_place + in.number(region_model::kAnchorGap);
    const std::uint32_t group =
        next_group + static_cast<std::uint32_t>(unfold_sign(in.number(region_model::kGroupStep)));
    if (place >= order.size() || !in.ok()) return false;
    mesh.anchors.push_back({order[place], group});
    next_place = place + 1;
    next_group = group + 1;
  }
  return true;
}

}  // namespace

// In step with encode_positions.
Result<void> decode_positions(Decoder& in, const GridBox& box, std::uint32_t vertices,
                              const CodecTables& tables, const FanTable& table, GeometryWalk::Memory& memory,
                              RegionMesh& mesh) {
  Blends blends;
  if (!decode_blends(in, blends)) return corrupt("impossible blends");
  const Predictor predictor(tables, blends);
  const LaneBox lane_box(box);
  GeometryWalk walk(table, vertices, box.extent(), memory);
  IntLanes outside{};
  for (Surroundings around{}; walk.next_vertex(around);) {
    if (around.has_neighbours) {
      decode_position(in, predictor, around, lane_box, walk, outside);
      continue;
    }
    GridPoint position;
    if (!decode_offset(in, box, position)) return corrupt("a position outside the box");
    walk.place_first(position);
  }
  if (!in.ok() || (outside[0] | outside[1] | outside[2]) < 0) return corrupt("a position outside the box");
  if (!walk.order().is_complete() || walk.count() != vertices)
    return corrupt("not the promised number of vertices");
  mesh.positions = walk.positions();
  mesh.triangles = walk.order().triangles();
  mesh.loops = walk.order().boundary_loops();
  return {};
}

Result<void> decode_loose_positions(Decoder& in, std::uint32_t count, const GridBox& box, RegionMesh& mesh) {
  for (std::uint32_t v = 0; v < count; ++v) {
    GridPoint position;
    if (!decode_offset(in, box, position)) return corrupt("a position outside the box");
    mesh.positions.push_back(position);
  }
  return {};
}

Result<void> decode_turned_and_anchors(Decoder& in, const RegionPartHeader& header, RegionMesh& mesh) {
  if (header.has_turned)
    mesh.is_turned = decode_turned(in, static_cast<std::uint32_t>(mesh.triangles.size()));
  if (header.has_anchors && !decode_anchors(in, mesh)) return corrupt("impossible anchors");
  if (!in.is_finished()) return corrupt("bytes left over or missing");
  return {};
}

}  // namespace selvage
