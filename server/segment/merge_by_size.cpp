// SPDX-License-Identifier: MIT
#include "server/segment/merge_by_size.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "server/segment/region_graph.h"

namespace selvage {
namespace {

/// Node ids of the graph depend on which side had more neighbours; the label a merged region goes by is the
/// target's, as in the table. These arrays translate.
struct Names {
  explicit Names(std::uint32_t count) : label_of_node(count), node_of_label(count) {
    std::iota(label_of_node.begin(), label_of_node.end(), 0u);
    std::iota(node_of_label.begin(), node_of_label.end(), 0u);
  }
  std::vector<std::uint32_t> label_of_node, node_of_label;  // kNone: the label is used up
};

/// The label of the neighbour with the longest common boundary, kNone without neighbours.
std::uint32_t best_target(const RegionGraph& graph, const Names& names, std::uint32_t node) {
  std::uint32_t best = kNone, longest = 0;
  for (const auto& [other, border] : graph.neighbours(node)) {
    const std::uint32_t label = names.label_of_node[other];
    if (border.edges > longest || (border.edges == longest && label < best)) {
      best = label;
      longest = border.edges;
    }
  }
  return best;
}

}  // namespace

std::uint32_t default_merge_threshold(std::uint32_t vertex_count) { return std::max(3u, vertex_count / 100); }

std::uint32_t merge_by_size(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex,
                            std::uint32_t region_count, std::uint32_t min_vertices) {
  RegionGraph graph(mesh, label_of_vertex, region_count);
  Names names(region_count);
  for (bool has_merged = true; has_merged;) {
    has_merged = false;
    for (std::uint32_t label = 0; label < region_count; ++label) {
      const std::uint32_t node = names.node_of_label[label];
      if (node == kNone || graph.vertex_count(node) >= min_vertices) continue;
      const std::uint32_t target = best_target(graph, names, node);
      if (target == kNone) continue;
      const std::uint32_t survivor = graph.merge(node, names.node_of_label[target]);
      names.node_of_label[label] = kNone;
      names.node_of_label[target] = survivor;
      names.label_of_node[survivor] = target;
      has_merged = true;
    }
  }
  return graph.relabel(label_of_vertex);
}

}  // namespace selvage
