// SPDX-License-Identifier: MIT
#include "server/encode/attribute_encoder.h"

#include <algorithm>
#include <cstdlib>

#include "server/encode/blend_choice.h"

namespace selvage {
namespace {

std::uint32_t magnitude_of(std::int32_t residual) { return static_cast<std::uint32_t>(std::abs(residual)); }

void encode_residual(EntropyEncoder& out, unsigned model, const SizeClass& size, std::int32_t residual) {
  const std::uint32_t magnitude = magnitude_of(residual);
  const std::uint32_t coarse = magnitude >> size.raw_low_bits;
  out.symbol(model, std::min(coarse, kMagnitudeEscape));
  if (coarse >= kMagnitudeEscape) out.number(region_model::kExcess, coarse - kMagnitudeEscape);
  const std::uint32_t low = magnitude & ((1u << size.raw_low_bits) - 1);
  if (coarse == 0 && size.raw_low_bits == 0) return;
  out.bits(low, size.raw_low_bits);
  if (magnitude != 0) out.bits(residual < 0, 1);
}

void encode_offset(EntropyEncoder& out, const GridPoint& position, const GridBox& box) {
  for (int axis = 0; axis < 3; ++axis)
    out.bits(static_cast<std::uint32_t>(position[axis] - box.low[axis]), box.offset_bits(axis));
}

void encode_turned(EntropyEncoder& out, const std::vector<bool>& is_turned) {
  bool before = false;
  for (bool turned : is_turned) {
    out.symbol(region_model::kTurned + before, turned);
    before = turned;
  }
}

void encode_anchors(EntropyEncoder& out, const RegionMesh& mesh) {
  std::vector<std::uint32_t> place_of_vertex(mesh.table.vertex_count());
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.table.vertex_count());
  for (std::uint32_t place = 0; place < order.size(); ++place) place_of_vertex[order[place]] = place;
  out.number(region_model::kAnchorCount, static_cast<std::uint32_t>(mesh.anchors.size()));
  std::uint32_t next_place = 0, next_group = 0;
  for (const Anchor& anchor : mesh.anchors) {
    const std::uint32_t place = place_of_vertex[anchor.vertex];
    out.number(region_model::kAnchorGap, place - next_place);
    out.number(region_model::kGroupStep, fold_sign(static_cast<std::int32_t>(anchor.group - next_group)));
    next_place = place + 1;
    next_group = anchor.group + 1;
  }
}

}  // namespace

// In step with decode_positions.
std::vector<VertexId> encode_positions(const CornerTable& table, std::span<const GridPoint> positions,
                                       const GridBox& box, const CodecTables& tables, EntropyEncoder& out) {
  const Blends blends = choose_blends(table, positions, box, tables);
  out.symbol(region_model::kShape, blends.shape);
  out.symbol(region_model::kTrend, blends.trend);
  out.symbol(region_model::kTangent, blends.tangent);
  GeometryWalk walk(table, tables, blends, box.extent());
  std::vector<VertexId> order;
  for (Surroundings around; walk.next_vertex(around);) {
    const GridPoint& position = positions[walk.old_number()];
    order.push_back(walk.old_number());
    if (around.neighbours == 0) {
      encode_offset(out, position, box);
      walk.place_first(position);
      continue;
    }
    const GridPoint residual = position - walk.predict(around);
    const unsigned d = around.normal_axis;
    const auto u = residual[static_cast<int>((d + 1) % 3)], w = residual[static_cast<int>((d + 2) % 3)];
    const SizeClass first = walk.size_class(around, 0, 0, 0, 0);
    encode_residual(out, magnitude_model(0, around, first), first, u);
    const SizeClass second = walk.size_class(around, 1, magnitude_of(u), 0, 0);
    encode_residual(out, magnitude_model(1, around, second), second, w);
    const std::int32_t tangent = walk.tangent_residual(around, u, w);
    const std::int32_t last = residual[static_cast<int>(d)] - tangent;
    const SizeClass third =
        walk.size_class(around, 2, magnitude_of(u), magnitude_of(w), magnitude_of(tangent));
    encode_residual(out, magnitude_model(2, around, third), third, last);
    walk.place(around, position, magnitude_of(u) + magnitude_of(w), magnitude_of(last));
  }
  return order;
}

void encode_loose_positions(std::span<const GridPoint> positions, const GridBox& box, EntropyEncoder& out) {
  for (const GridPoint& position : positions) encode_offset(out, position, box);
}

void encode_turned_and_anchors(const RegionMesh& mesh, EntropyEncoder& out) {
  encode_turned(out, mesh.is_turned);
  if (!mesh.anchors.empty()) encode_anchors(out, mesh);
}

}  // namespace selvage
