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
  BoundaryLoops loops;
  std::vector<bool> is_visited(table.vertex_count(), false);
  for (VertexId start = 0; start < table.vertex_count(); ++start) {
    if (is_visited[start] || !is_on_border(table, start)) continue;
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
