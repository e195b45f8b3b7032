// SPDX-License-Identifier: MIT
#include "client/decode/attribute_decoder.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace selvage {
namespace {

using Decoder = EntropyDecoder<2>;

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt attributes, ") + what);
}

std::uint32_t magnitude_of(std::int32_t residual) { return static_cast<std::uint32_t>(std::abs(residual)); }

/// kMaxResidual stands for anything beyond what an encoder writes.
std::int32_t decode_residual(Decoder& in, unsigned model, const SizeClass& size) {
  std::uint32_t coarse = in.symbol(model);
  if (coarse == kMagnitudeEscape) coarse += std::min(in.number(region_model::kExcess), kMaxResidual);
  if (coarse > kMaxResidual >> size.raw_low_bits) return static_cast<std::int32_t>(kMaxResidual);
  return in.signed_bits(coarse, size.raw_low_bits);
}

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

/// A position that something predicts.
GridPoint decode_position(Decoder& in, GeometryWalk& walk, const Surroundings& around) {
  const unsigned d = around.normal_axis;
  const SizeClass first = walk.size_class(around, 0, 0, 0, 0);
  const std::int32_t u = decode_residual(in, magnitude_model(0, around, first), first);
  const SizeClass second = walk.size_class(around, 1, magnitude_of(u), 0, 0);
  const std::int32_t w = decode_residual(in, magnitude_model(1, around, second), second);
  const std::int32_t tangent = walk.tangent_residual(around, u, w);
  const SizeClass third = walk.size_class(around, 2, magnitude_of(u), magnitude_of(w), magnitude_of(tangent));
  const std::int32_t last = decode_residual(in, magnitude_model(2, around, third), third);
  const std::int32_t n = last + tangent;
  GridPoint position = walk.predict(around);
  position.x += d == 0 ? n : d == 1 ? w : u;
  position.y += d == 0 ? u : d == 1 ? n : w;
  position.z += d == 0 ? w : d == 1 ? u : n;
  walk.place(around, position, magnitude_of(u) + magnitude_of(w), magnitude_of(last));
  return position;
}

std::vector<bool> decode_turned(Decoder& in, std::uint32_t triangles) {
  std::vector<bool> is_turned(triangles);
  bool before = false;
  for (TriangleId t = 0; t < triangles; ++t)
    is_turned[t] = before = in.symbol(region_model::kTurned + before) != 0;
  return is_turned;
}

bool decode_anchors(Decoder& in, RegionMesh& mesh) {
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.table.vertex_count());
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
Result<void> decode_positions(Decoder& in, const GridBox& box, const CodecTables& tables, RegionMesh& mesh) {
  Blends blends;
  if (!decode_blends(in, blends)) return corrupt("impossible blends");
  GeometryWalk walk(std::move(mesh.table), tables, blends, box.extent());
  for (Surroundings around; walk.next_vertex(around);) {
    GridPoint position;
    bool is_sound;
    if (around.neighbours == 0) {
      is_sound = decode_offset(in, box, position);
      walk.place_first(position);
    } else {
      position = decode_position(in, walk, around);
      is_sound = box.holds(position) && in.ok();
    }
    if (!is_sound) return corrupt("a position outside the box");
  }
  mesh.table = walk.take_table();
  mesh.positions = walk.positions();
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
  if (header.has_turned) mesh.is_turned = decode_turned(in, mesh.table.triangle_count());
  if (header.has_anchors && !decode_anchors(in, mesh)) return corrupt("impossible anchors");
  if (!in.is_finished()) return corrupt("bytes left over or missing");
  return {};
}

}  // namespace selvage
