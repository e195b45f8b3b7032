// SPDX-License-Identifier: MIT
#include "server/encode/level_encoder.h"

#include "server/encode/region_encoder.h"

namespace selvage {

LevelEncoder::LevelEncoder(const ModelSource& source, const Grid& grid,
                           std::span<const std::uint32_t> weld_group_of_vertex, std::size_t level)
    : source_(source),
      grid_(grid),
      weld_group_of_vertex_(weld_group_of_vertex),
      representative_of_vertex_(source.levels->representative_of_vertex[level]),
      regions_(source.levels->regions[level]),
      local_of_vertex_(source.positions.size(), kNone),
      local_of_triangle_(source.table.triangle_count(), kNone) {
  for (const RegionLevel& region : regions_) {
    for (std::uint32_t i = 0; i < region.vertices.size(); ++i) local_of_vertex_[region.vertices[i]] = i;
    for (std::uint32_t i = 0; i < region.triangles.size(); ++i) local_of_triangle_[region.triangles[i]] = i;
  }
}

/// Gives the triangles that are left their neighbours. Those across the region's border are boundary
/// triangles, which have no local number.
CornerTable LevelEncoder::cut_table(const RegionLevel& level) const {
  CornerTable cut;
  cut.vertex_of_corner.reserve(3 * level.triangles.size());
  cut.opposite.reserve(3 * level.triangles.size());
  for (const TriangleId t : level.triangles) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      cut.vertex_of_corner.push_back(local_of_vertex_[representative_of_vertex_[source_.table.vertex(c)]]);
      const CornerId across = corner_across(source_.table, representative_of_vertex_, c);
      const std::uint32_t local = across == kNone ? kNone : local_of_triangle_[triangle_of(across)];
      cut.opposite.push_back(local == kNone ? kNone : 3 * local + across % 3);
    }
  }
  cut.set_corner_of_vertex(static_cast<std::uint32_t>(level.vertices.size()));
  return cut;
}

Bytes LevelEncoder::encode(RegionId region, const RegionEntry& finest,
                           std::span<const VertexId> boundary_vertices, const CodecTables& tables,
                           EntropyEncoder* symbols) const {
  const RegionLevel& level = regions_[region];
  RegionSource cut;
  cut.table = cut_table(level);
  for (const VertexId v : level.vertices) cut.positions.push_back(grid_.quantise(source_.positions[v]));
  for (const TriangleId t : level.triangles) cut.is_turned.push_back(source_.is_turned[t]);
  if (!weld_group_of_vertex_.empty()) {
    for (const VertexId v : level.vertices) cut.weld_groups.push_back(weld_group_of_vertex_[v]);
  }
  std::vector<VertexId> vertex_of_boundary;
  for (const VertexId v : boundary_vertices)
    vertex_of_boundary.push_back(local_of_vertex_[representative_of_vertex_[v]]);
  cut.coarse = CoarseSource{
      finest.loop_lengths, vertex_of_boundary, {finest.box_min, finest.box_max}, level.dropped_bits};
  return encode_region(cut, tables, symbols).bytes;
}

}  // namespace selvage
