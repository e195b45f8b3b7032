// SPDX-License-Identifier: MIT
#include "server/encode/attribute_encoder.h"

#include <algorithm>
#include <cstdlib>

#include "server/encode/blend_choice.h"

namespace selvage {
namespace {

/// The symbol of a magnitude, and what the next axis's class makes of it.
std::int32_t encode_magnitude(EntropyEncoder& out, unsigned model, const SizeClass& size,
                              std::uint32_t magnitude) {
  const std::uint32_t coarse = magnitude >> size.raw_low_bits, symbol = std::min(coarse, kMagnitudeEscape);
  out.symbol(model, symbol);
  if (symbol == kMagnitudeEscape) out.number(region_model::kExcess, coarse - kMagnitudeEscape);
  return coarse_log(symbol, size);
}

void encode_sign_and_low_bits(EntropyEncoder& out, const SizeClass& size, std::int32_t residual) {
  if (residual == 0 && size.raw_low_bits == 0) return;
  out.bits(residual < 0, 1);
  out.bits(magnitude_of(residual) & ((1u << size.raw_low_bits) - 1), size.raw_low_bits);
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
  std::vector<std::uint32_t> place_of_vertex(mesh.vertex_count());
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.vertex_count());
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
CodingOrder encode_positions(const FanTable& table, std::span<const GridPoint> positions, const GridBox& box,
                             const CodecTables& tables, EntropyEncoder& out) {
  const Blends blends = choose_blends(table, positions, box, tables);
  out.symbol(region_model::kShape, blends.shape);
  out.symbol(region_model::kTrend, blends.trend);
  out.symbol(region_model::kTangent, blends.tangent);
  const Predictor predictor(tables, blends);
  GeometryWalk::Memory memory;
  GeometryWalk walk(table, table.vertex_count(), box.extent(), memory);
  CodingOrder order;
  for (Surroundings around{}; walk.next_vertex(around);) {
    const GridPoint& position = positions[walk.old_number()];
    order.vertices.push_back(walk.old_number());
    if (!around.has_neighbours) {
      encode_offset(out, position, box);
      walk.place_first(position);
      continue;
    }
    const IntLanes lanes{position.x, position.y, position.z, 0};
    const CodedResidual residual = residual_of(predictor, around, lanes);
    const IntLanes expected = predictor.expected_sizes(around);
    const std::uint32_t u = magnitude_of(residual.u), w = magnitude_of(residual.w),
                        last = magnitude_of(residual.last);
    const SizeClass first = predictor.size_class(around, expected, 0, 0, 0);
    const std::int32_t log_u = encode_magnitude(out, magnitude_model(0, around, first), first, u);
    const SizeClass second = predictor.size_class(around, expected, 1, log_u, 0);
    const std::int32_t log_w = encode_magnitude(out, magnitude_model(1, around, second), second, w);
    const SizeClass third = predictor.size_class(around, expected, 2, log_u, log_w);
    encode_magnitude(out, magnitude_model(2, around, third), third, last);
    encode_sign_and_low_bits(out, first, residual.u);
    encode_sign_and_low_bits(out, second, residual.w);
    encode_sign_and_low_bits(out, third, residual.last);
    walk.place(around, lanes, u + w, last);
  }
  order.triangles = walk.order().triangles();
  order.loops = walk.order().boundary_loops();
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
