// SPDX-License-Identifier: MIT
#include "client/decode/attribute_decoder.h"

#include <numeric>

#include "common/codec/residual.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

using Decoder = EntropyDecoder<2>;

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt attributes, ") + what);
}

/// kMaxResidual stands for anything beyond what an encoder writes.
std::int32_t decode_residual(Decoder& in, ResidualModels& models, const ResidualContext& context) {
  std::uint32_t coarse = in.symbol(models.magnitude[context.index]);
  if (coarse == ResidualModels::kEscape) {
    const std::uint32_t excess = in.number(models.excess);
    coarse += std::min(excess, kMaxResidual);
  }
  if (coarse > kMaxResidual >> context.raw_low_bits) return static_cast<std::int32_t>(kMaxResidual);
  const std::uint32_t magnitude = (coarse << context.raw_low_bits) + in.bits(context.raw_low_bits);
  const bool is_negative = magnitude != 0 && in.bits(1) != 0;
  return is_negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
}

bool is_within(const GridPoint& p, std::int32_t last) {
  return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= last && p.y <= last && p.z <= last;
}

bool decode_positions(Decoder& in, const CornerTable& table, int bits, std::vector<GridPoint>& positions) {
  const std::int32_t last = (std::int32_t{1} << bits) - 1;
  ResidualModels models;
  Predictor predictor(table, bits);
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    const Prediction prediction = predictor.predict();
    GridPoint residual;
    for (int axis = 0; axis < 3; ++axis) residual[axis] = decode_residual(in, models, prediction.context);
    const GridPoint position = prediction.position + residual;
    if (!is_within(position, last) || !in.ok()) return false;
    predictor.append(position, residual);
  }
  positions = std::move(predictor).take();
  return true;
}

std::vector<bool> decode_turned(Decoder& in, AttributeModels& models, std::uint32_t triangles) {
  std::vector<bool> is_turned(triangles);
  bool before = false;
  for (TriangleId t = 0; t < triangles; ++t) is_turned[t] = before = in.symbol(models.turned[before]) != 0;
  return is_turned;
}

bool decode_anchors(Decoder& in, AttributeModels& models, RegionMesh& mesh) {
  const std::vector<VertexId> order = anchor_order(mesh.loops, mesh.table.vertex_count());
  const std::uint32_t count = in.bits(32);
  if (count > order.size() || count == 0) return false;
  std::uint64_t next_place = 0;
  std::uint32_t next_group = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t place = next_place + in.number(models.anchor_gap);
    const std::uint32_t group =
        next_group + static_cast<std::uint32_t>(unfold_sign(in.number(models.group_step)));
    if (place >= order.size() || !in.ok()) return false;
    mesh.anchors.push_back({order[place], group});
    next_place = place + 1;
    next_group = group + 1;
  }
  return true;
}

/// Loose vertices have no triangles; all of them are boundary vertices.
bool decode_loose_count(Decoder& in, AttributeModels& models, std::uint32_t expected, RegionMesh& mesh) {
  const std::uint32_t count = in.number(models.loose_count);
  if (count == 0 || count != expected) return false;
  mesh.table.set_corner_of_vertex(count);
  mesh.loops.vertices.resize(count);
  std::iota(mesh.loops.vertices.begin(), mesh.loops.vertices.end(), VertexId{0});
  mesh.loops.lengths = {count};
  return true;
}

}  // namespace

Result<void> decode_attributes(std::span<const std::byte> bytes, const RegionPartHeader& header,
                               std::uint32_t loose_vertices, RegionMesh& mesh) {
  Decoder in(bytes);
  AttributeModels models;
  if (header.symbols == 0 && !decode_loose_count(in, models, loose_vertices, mesh))
    return corrupt("impossible number of loose vertices");
  if (!decode_positions(in, mesh.table, header.bits, mesh.positions))
    return corrupt("a position off the grid");
  if (header.has_turned) mesh.is_turned = decode_turned(in, models, mesh.table.triangle_count());
  if (header.has_anchors && !decode_anchors(in, models, mesh)) return corrupt("impossible anchors");
  if (!in.is_finished()) return corrupt("bytes left over or missing");
  return {};
}

}  // namespace selvage
