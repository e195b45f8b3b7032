// SPDX-License-Identifier: MIT
#include "server/segment/region_graph.h"

#include <cassert>
#include <numeric>
#include <utility>

namespace selvage {

RegionGraph::RegionGraph(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                         std::uint32_t region_count, const MeasureEdge& measure)
    : parent_(region_count), neighbours_(region_count), vertex_count_(region_count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (std::uint32_t label : label_of_vertex) ++vertex_count_[label];
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    if (mesh.opposite[c] != kNone && mesh.opposite[c] < c) continue;  // once an edge
    const std::uint32_t a = label_of_vertex[mesh.vertex(next(c))], b = label_of_vertex[mesh.vertex(prev(c))];
    if (a == b) continue;
    RegionBorder edge = measure ? measure(c) : RegionBorder{};
    edge.edges = 1;
    neighbours_[a][b] += edge;
    neighbours_[b][a] += edge;
  }
}

std::uint32_t RegionGraph::find(std::uint32_t node) const {
  while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
  return node;
}

std::uint32_t RegionGraph::merge(std::uint32_t a, std::uint32_t b) {
  assert(a != b && parent_[a] == a && parent_[b] == b);
  if (neighbours_[a].size() < neighbours_[b].size() ||
      (neighbours_[a].size() == neighbours_[b].size() && b < a)) {
    std::swap(a, b);
  }
  neighbours_[a].erase(b);
  for (const auto& [other, border] : neighbours_[b]) {
    if (other == a) continue;
    neighbours_[a][other] += border;
    neighbours_[other].erase(b);
    neighbours_[other][a] += border;
  }
  Neighbours().swap(neighbours_[b]);
  parent_[b] = a;
  vertex_count_[a] += vertex_count_[b];
  return a;
}

std::uint32_t RegionGraph::relabel(std::span<std::uint32_t> label_of_vertex) const {
  std::vector<std::uint32_t> number_of_node(size(), kNone);
  std::uint32_t count = 0;
  for (std::uint32_t& label : label_of_vertex) {
    std::uint32_t& number = number_of_node[find(label)];
    if (number == kNone) number = count++;
    label = number;
  }
  return count;
}

}  // namespace selvage
