// SPDX-License-Identifier: MIT
#include "server/segment/merge_by_depth.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "server/segment/region_graph.h"

namespace selvage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Shallow {
  double depth;
  std::uint32_t node, version;
  /// The priority queue gives its greatest element: the shallowest.
  friend bool operator<(const Shallow& x, const Shallow& y) {
    return std::tie(x.depth, x.node) > std::tie(y.depth, y.node);
  }
};

struct Pass {
  std::uint32_t beyond = kNone;
  double height = kInfinity;
};

Pass lowest_pass(const RegionGraph& graph, std::uint32_t node) {
  Pass lowest;
  for (const auto& [other, border] : graph.neighbours(node)) {
    if (std::tie(border.pass, other) < std::tie(lowest.height, lowest.beyond)) lowest = {other, border.pass};
  }
  return lowest;
}

}  // namespace

void merge_by_depth(const CornerTable& mesh, std::span<const double> height_of_vertex, Minima& labels,
                    std::uint32_t target_count) {
  RegionGraph graph(mesh, labels.label_of_vertex, labels.count, [&](CornerId c) {
    const double u = height_of_vertex[mesh.vertex(next(c))], v = height_of_vertex[mesh.vertex(prev(c))];
    return RegionBorder{.pass = std::max(u, v)};
  });
  std::vector<double> bottom(labels.count, kInfinity);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    double& lowest = bottom[labels.label_of_vertex[v]];
    lowest = std::min(lowest, height_of_vertex[v]);
  }

  std::vector<std::uint32_t> version(labels.count, 0);
  std::priority_queue<Shallow> queue;
  const auto queue_region = [&](std::uint32_t node) {
    const Pass pass = lowest_pass(graph, node);
    if (pass.beyond != kNone) queue.push({pass.height - bottom[node], node, version[node]});
  };
  for (std::uint32_t node = 0; node < labels.count; ++node) queue_region(node);
  for (std::uint32_t left = labels.count; left > target_count && !queue.empty();) {
    const Shallow shallowest = queue.top();
    queue.pop();
    if (graph.find(shallowest.node) != shallowest.node || version[shallowest.node] != shallowest.version)
      continue;
    const std::uint32_t other = lowest_pass(graph, shallowest.node).beyond;
    const double lowest = std::min(bottom[shallowest.node], bottom[other]);
    const std::uint32_t survivor = graph.merge(shallowest.node, other);
    bottom[survivor] = lowest;
    ++version[survivor];
    --left;
    queue_region(survivor);
  }
  labels.count = graph.relabel(labels.label_of_vertex);
}

}  // namespace selvage
