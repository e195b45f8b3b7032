// SPDX-License-Identifier: MIT
#include "common/codec/connectivity.h"

#include <algorithm>

namespace selvage {
namespace {

bool is_strictly_ascending_below(std::span<const VertexId> vertices, std::uint32_t limit) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] >= limit || (i > 0 && vertices[i] <= vertices[i - 1])) return false;
  }
  return true;
}

/// Compacts the table to the triangles that touch no virtual vertex; returns their grown numbers.
std::vector<TriangleId> drop_virtual_fans(CornerTable& table, std::span<const VertexId> virtual_vertices) {
  std::vector<bool> is_virtual(table.vertex_count(), false);
  for (VertexId v : virtual_vertices) is_virtual[v] = true;
  std::vector<TriangleId> kept;
  std::vector<TriangleId> new_of_grown(table.triangle_count(), kNone);
  for (TriangleId t = 0; t < table.triangle_count(); ++t) {
    const auto [a, b, c] = table.triangle(t);
    if (is_virtual[a] || is_virtual[b] || is_virtual[c]) continue;
    new_of_grown[t] = static_cast<TriangleId>(kept.size());
    kept.push_back(t);
  }
  for (TriangleId t = 0; t < kept.size(); ++t) {
    for (CornerId k = 0; k < 3; ++k) {
      const CornerId grown = 3 * kept[t] + k;
      const CornerId across = table.opposite[grown];
      const TriangleId neighbour = across == kNone ? kNone : new_of_grown[triangle_of(across)];
      table.vertex_of_corner[3 * t + k] = table.vertex_of_corner[grown];
      table.opposite[3 * t + k] = neighbour == kNone ? kNone : 3 * neighbour + across % 3;
    }
  }
  table.vertex_of_corner.resize(3 * kept.size());
  table.opposite.resize(3 * kept.size());
  table.set_corner_of_vertex(table.vertex_count());
  return kept;
}

/// Taking fans away may leave a vertex that two of them shared with two fans of its own.
bool has_two_open_fans(const CornerTable& table) {
  std::vector<bool> is_open(table.vertex_count(), false);
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    if (table.opposite[prev(c)] != kNone) continue;
    if (is_open[table.vertex(c)]) return true;
    is_open[table.vertex(c)] = true;
  }
  return false;
}

}  // namespace

std::optional<Connectivity> finish_connectivity(CornerTable grown,
                                                std::span<const VertexId> virtual_vertices) {
  if (!is_strictly_ascending_below(virtual_vertices, grown.vertex_count())) return std::nullopt;
  Connectivity result;
  if (!virtual_vertices.empty()) {
    result.grown_of_triangle = drop_virtual_fans(grown, virtual_vertices);
    if (has_two_open_fans(grown)) return std::nullopt;
  }
  result.table = std::move(grown);
  return result;
}

}  // namespace selvage
