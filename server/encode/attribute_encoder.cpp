// SPDX-License-Identifier: MIT
#include "server/encode/attribute_encoder.h"

#include <cstdlib>

#include "common/codec/region_format.h"
#include "common/codec/residual.h"
#include "common/coding/entropy_encoder.h"

namespace selvage {
namespace {

void encode_residual(EntropyEncoder& out, ResidualModels& models, const ResidualContext& context,
                     std::int32_t residual) {
  const auto magnitude = static_cast<std::uint32_t>(std::abs(residual));
  const std::uint32_t coarse = magnitude >> context.raw_low_bits;
  out.symbol(models.magnitude[context.index], std::min(coarse, ResidualModels::kEscape));
  if (coarse >= ResidualModels::kEscape) out.number(models.excess, coarse - ResidualModels::kEscape);
  out.bits(magnitude & ((1u << context.raw_low_bits) - 1), context.raw_low_bits);
  if (magnitude != 0) out.bits(residual < 0, 1);
}

void encode_positions(EntropyEncoder& out, const RegionMesh& mesh, int bits) {
  ResidualModels models;
  Predictor predictor(mesh.table, bits);
  for (const GridPoint& position : mesh.positions) {
    const Prediction prediction = predictor.predict();
    const GridPoint residual = position - prediction.position;
    for (int axis = 0; axis < 3; ++axis) encode_residual(out, models, prediction.context, residual[axis]);
    predictor.append(position, residual);
  }
}

void encode_turned(EntropyEncoder& out, AttributeModels& models, const std::vector<bool>& is_turned) {
  bool before = false;
  for (bool turned : is_turned) {
    out.symbol(models.turned[before], turned);
    before = turned;
  }
}

void encode_anchors(EntropyEncoder& out, AttributeModels& models, const RegionMesh& mesh) {
  std::vector<std::uint32_t> place_of_vertex(mesh.table.vertex_count());
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.table.vertex_count());
  for (std::uint32_t place = 0; place < order.size(); ++place) place_of_vertex[order[place]] = place;
  out.bits(static_cast<std::uint32_t>(mesh.anchors.size()), 32);
  std::uint32_t next_place = 0, next_group = 0;
  for (const Anchor& anchor : mesh.anchors) {
    const std::uint32_t place = place_of_vertex[anchor.vertex];
    out.number(models.anchor_gap, place - next_place);
    out.number(models.group_step, fold_sign(static_cast<std::int32_t>(anchor.group - next_group)));
    next_place = place + 1;
    next_group = anchor.group + 1;
  }
}

}  // namespace

Bytes encode_attributes(const RegionMesh& mesh, int bits) {
  EntropyEncoder out;
  AttributeModels models;
  if (mesh.table.triangle_count() == 0) out.number(models.loose_count, mesh.table.vertex_count());
  encode_positions(out, mesh, bits);
  encode_turned(out, models, mesh.is_turned);
  if (!mesh.anchors.empty()) encode_anchors(out, models, mesh);
  return out.finish<2>();
}

}  // namespace selvage
