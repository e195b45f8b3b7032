// SPDX-License-Identifier: MIT
#include "common/mesh/boundary_loops.h"

namespace selvage {
namespace {

/// The border half-edge that leaves a border vertex v is the edge v -> vertex(next(c)) of its most clockwise
/// corner c: nothing lies clockwise of it.
VertexId next_on_border(const CornerTable& table, VertexId v) {
  return table.vertex(next(table.corner_of_vertex[v]));
}

bool is_on_border(const CornerTable& table, VertexId v) {
  return table.corner_of_vertex[v] != kNone && table.is_border_vertex(v);
}

}  // namespace

BoundaryLoops find_boundary_loops(const CornerTable& table) {
  std::vector<VertexId> border_vertices;
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    if (is_on_border(table, v)) border_vertices.push_back(v);
  }
  return find_boundary_loops(table, border_vertices);
}

BoundaryLoops find_boundary_loops(const CornerTable& table, std::span<const VertexId> border_vertices) {
  BoundaryLoops loops;
  if (border_vertices.empty()) return loops;
  std::vector<bool> is_visited(table.vertex_count(), false);
  loops.vertices.reserve(border_vertices.size());
  for (VertexId start : border_vertices) {
    if (is_visited[start]) continue;
    std::uint32_t length = 0;
    for (VertexId v = start; !is_visited[v]; v = next_on_border(table, v)) {
      is_visited[v] = true;
      loops.vertices.push_back(v);
      ++length;
    }
    loops.lengths.push_back(length);
  }
  return loops;
}

}  // namespace selvage
