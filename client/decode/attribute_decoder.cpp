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
  if (coarse == 0 && size.raw_low_bits == 0) return 0;
  if (coarse > kMaxResidual >> size.raw_low_bits) return static_cast<std::int32_t>(kMaxResidual);
  const std::uint32_t magnitude = (coarse << size.raw_low_bits) + in.bits(size.raw_low_bits);
  const bool is_negative = magnitude != 0 && in.bits(1) != 0;
  return is_negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
}

bool decode_blends(Decoder& in, Blends& blends) {
  blends.shape = in.symbol(region_model::kShape);
  blends.trend = in.symbol(region_model::kTrend);
  blends.tangent = in.symbol(region_model::kTangent);
  return blends.shape <= Blends::kMax && blends.trend <= Blends::kMax &&
         blends.tangent <= Blends::kMaxTangent;
}

// In step with encode_positions.
bool decode_positions(Decoder& in, const CornerTable& table, const GridBox& box, const CodecTables& tables,
                      std::vector<GridPoint>& positions) {
  Blends blends;
  if (!decode_blends(in, blends)) return false;
  Predictor predictor(table, tables, blends, box.extent());
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    const Surroundings around = predictor.look_around();
    GridPoint position;
    if (around.neighbours == 0) {
      for (int axis = 0; axis < 3; ++axis)
        position[axis] = box.low[axis] + static_cast<std::int32_t>(in.bits(box.offset_bits(axis)));
      if (!box.holds(position) || !in.ok()) return false;
      predictor.append_first(position);
      continue;
    }
    const unsigned d = around.normal_axis;
    const SizeClass first = predictor.size_class(around, 0, predictor.size_features(around, 0, 0, 0));
    const std::int32_t u = decode_residual(in, magnitude_model(0, around, first), first);
    const SizeClass second =
        predictor.size_class(around, 1, predictor.size_features(around, magnitude_of(u), 0, 0));
    const std::int32_t w = decode_residual(in, magnitude_model(1, around, second), second);
    const std::int32_t tangent = predictor.tangent_residual(around, u, w);
    const SizeClass third = predictor.size_class(
        around, 2, predictor.size_features(around, magnitude_of(u), magnitude_of(w), magnitude_of(tangent)));
    const std::int32_t last = decode_residual(in, magnitude_model(2, around, third), third);
    GridPoint residual;
    residual[static_cast<int>((d + 1) % 3)] = u;
    residual[static_cast<int>((d + 2) % 3)] = w;
    residual[static_cast<int>(d)] = last + tangent;
    position = predictor.predict(around) + residual;
    if (!box.holds(position) || !in.ok()) return false;
    predictor.append(around, position, magnitude_of(u) + magnitude_of(w), magnitude_of(last));
  }
  positions = predictor.positions();
  return true;
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

Result<void> decode_attributes(Decoder& in, const RegionPartHeader& header, const DecodeLimits& expected,
                               const CodecTables& tables, RegionMesh& mesh) {
  const GridBox box{expected.box_min, expected.box_max};
  if (!decode_positions(in, mesh.table, box, tables, mesh.positions))
    return corrupt("a position outside the box");
  if (header.has_turned) mesh.is_turned = decode_turned(in, mesh.table.triangle_count());
  if (header.has_anchors && !decode_anchors(in, mesh)) return corrupt("impossible anchors");
  if (!in.is_finished()) return corrupt("bytes left over or missing");
  return {};
}

}  // namespace selvage
