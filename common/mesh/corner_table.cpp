// SPDX-License-Identifier: MIT
#include "common/mesh/corner_table.h"

#include "common/mesh/edge_groups.h"

namespace selvage {

void CornerTable::set_corner_of_vertex(std::uint32_t vertex_count) {
  corner_of_vertex.assign(vertex_count, kNone);
  for (CornerId c = 0; c < corner_count(); ++c) {
    // An open fan has exactly one corner without a clockwise neighbour; it wins over any other.
    if (CornerId& chosen = corner_of_vertex[vertex_of_corner[c]]; chosen == kNone || opposite[prev(c)] == kNone) {
      chosen = c;
    }
  }
}

CornerTable build_corner_table(std::span<const Triangle> triangles, std::uint32_t vertex_count) {
  CornerTable table;
  table.vertex_of_corner.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) table.vertex_of_corner.insert(table.vertex_of_corner.end(), t.begin(), t.end());
  table.opposite.assign(table.vertex_of_corner.size(), kNone);

  const EdgeGroups edges = group_edges(triangles, vertex_count);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    const std::span<const CornerId> sides = edges[edge];
    const bool is_manifold = sides.size() == 2 && table.vertex(next(sides[0])) == table.vertex(prev(sides[1]));
    if (!is_manifold) continue;
    table.opposite[sides[0]] = sides[1];
    table.opposite[sides[1]] = sides[0];
  }
  table.set_corner_of_vertex(vertex_count);
  return table;
}

}  // namespace selvage
