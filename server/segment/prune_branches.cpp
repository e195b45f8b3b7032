// SPDX-License-Identifier: MIT
#include "server/segment/prune_branches.h"

#include <algorithm>
#include <vector>

#include "server/segment/one_ring.h"

namespace selvage {
namespace {

bool touches_boundary_triangles_only(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                                     VertexId v) {
  bool has_interior = false;
  for_each_corner_at(mesh, v, [&](CornerId c) {
    has_interior |= label_of_vertex[mesh.vertex(next(c))] == label_of_vertex[v] &&
                    label_of_vertex[mesh.vertex(prev(c))] == label_of_vertex[v];
  });
  return !has_interior;
}

/// The most frequent value, the lowest of equally frequent ones; kNone of none.
std::uint32_t most_frequent(std::vector<std::uint32_t>& values) {
  std::sort(values.begin(), values.end());
  std::uint32_t best = kNone;
  std::size_t best_count = 0;
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    while (end < values.size() && values[end] == values[begin]) ++end;
    if (end - begin > best_count) best = values[begin], best_count = end - begin;
  }
  return best;
}

}  // namespace

std::uint32_t prune_branches(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex) {
  std::uint32_t changed = 0;
  std::vector<std::uint32_t> others;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (!touches_boundary_triangles_only(mesh, label_of_vertex, v)) continue;
    others.clear();
    for_each_neighbour(mesh, v, [&](VertexId u) {
      if (label_of_vertex[u] != label_of_vertex[v]) others.push_back(label_of_vertex[u]);
    });
    if (others.empty()) continue;
    label_of_vertex[v] = most_frequent(others);
    ++changed;
  }
  return changed;
}

}  // namespace selvage
