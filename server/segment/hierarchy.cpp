// SPDX-License-Identifier: MIT
#include "server/segment/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "server/segment/region_graph.h"

namespace selvage {
namespace {

/// Length and concavity of the piece of border that crosses the edge which `c` faces: it runs through the
/// edge's two triangles, a third of their heights over it.
RegionBorder measure_edge(const CornerTable& mesh, std::span<const Vec3> positions,
                          std::span<const float> kappa, double deepest, CornerId c) {
  const VertexId u = mesh.vertex(next(c)), v = mesh.vertex(prev(c));
  const Vec3 edge = positions[v] - positions[u];
  const double edge_length = length(edge);
  if (!(edge_length > 0)) return {};
  double height_sum = length(cross(edge, positions[mesh.vertex(c)] - positions[u])) / edge_length;
  if (const CornerId across = mesh.opposite[c]; across != kNone) {
    height_sum += length(cross(edge, positions[mesh.vertex(across)] - positions[u])) / edge_length;
  }
  const double depth = std::clamp(-0.5 * (double{kappa[u]} + kappa[v]), 0.0, deepest);
  return {.length = height_sum / 3, .concavity = depth * height_sum / 3};
}

struct Candidate {
  double saliency;
  std::uint32_t name_a, name_b;  // a < b, for a deterministic order
  std::uint32_t version_a, version_b;
  /// The priority queue gives its greatest element: the least salient.
  friend bool operator<(const Candidate& x, const Candidate& y) {
    return std::tie(x.saliency, x.name_a, x.name_b) > std::tie(y.saliency, y.name_a, y.name_b);
  }
};

/// Contracts the graph. Regions go by names (the lowest basin in them), since which node survives a merge
/// depends on neighbour counts.
class Merger {
 public:
  Merger(RegionGraph graph, std::vector<double> area, std::vector<double> component_area,
         const HierarchyOptions& options)
      : graph_(std::move(graph)),
        area_(std::move(area)),
        component_area_(std::move(component_area)),
        options_(options),
        name_of_node_(graph_.size()),
        version_(graph_.size(), 0) {
    std::iota(name_of_node_.begin(), name_of_node_.end(), 0u);
  }

  std::vector<RegionMerge> run() {
    for (std::uint32_t node = 0; node < graph_.size(); ++node) queue_pairs_of(node, /*above=*/node);
    std::vector<RegionMerge> merges;
    while (!queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      const std::uint32_t a = graph_.find(best.name_a), b = graph_.find(best.name_b);
      if (version_[a] != best.version_a || version_[b] != best.version_b || a == b) continue;
      merges.push_back({best.name_a, best.name_b, best.saliency});
      merge(a, b, best.name_a);
    }
    return merges;
  }

 private:
  bool is_small(std::uint32_t node) const { return graph_.vertex_count(node) < options_.min_region_vertices; }

  bool may_merge(std::uint32_t a, std::uint32_t b) const {
    if (options_.max_region_vertices == 0 || is_small(a) || is_small(b)) return true;
    return graph_.vertex_count(a) + graph_.vertex_count(b) <= options_.max_region_vertices;
  }

  double saliency(std::uint32_t a, std::uint32_t b, const RegionBorder& border) const {
    constexpr double kForced = 1e-3;
    const double smaller = std::min(area_[a], area_[b]);
    // A border without length says nothing about its shape: as if as long as the region is wide.
    const double isoperimetric = border.length > 0 ? std::sqrt(std::sqrt(smaller) / border.length) : 1;
    const double depth = border.length > 0 ? border.concavity / border.length : 0;
    const bool is_forced =
        smaller < options_.min_area_share * component_area_[a] || is_small(a) || is_small(b);
    return (options_.flat_border + depth) * isoperimetric * (is_forced ? kForced : 1);
  }

  /// Queues the node's borders with nodes beyond `above` (kNone: with all).
  void queue_pairs_of(std::uint32_t node, std::uint32_t above) {
    for (const auto& [other, border] : graph_.neighbours(node)) {
      if ((above != kNone && other < above) || !may_merge(node, other)) continue;
      std::uint32_t a = node, b = other;
      if (name_of_node_[b] < name_of_node_[a]) std::swap(a, b);
      queue_.push({saliency(a, b, border), name_of_node_[a], name_of_node_[b], version_[a], version_[b]});
    }
  }

  void merge(std::uint32_t a, std::uint32_t b, std::uint32_t name) {
    const double area = area_[a] + area_[b];
    ++version_[a], ++version_[b];
    const std::uint32_t survivor = graph_.merge(a, b);
    area_[survivor] = area;
    name_of_node_[survivor] = name;
    queue_pairs_of(survivor, kNone);
  }

  RegionGraph graph_;
  std::vector<double> area_, component_area_;  // by node
  HierarchyOptions options_;
  std::vector<std::uint32_t> name_of_node_, version_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

std::size_t RegionHierarchy::merges_below(double stop) const {
  const auto above =
      std::find_if(merges.begin(), merges.end(), [&](const RegionMerge& m) { return m.saliency > stop; });
  return static_cast<std::size_t>(above - merges.begin());
}

std::size_t RegionHierarchy::merges_until(std::uint32_t regions) const {
  return regions >= basin_count ? 0 : std::min<std::size_t>(basin_count - regions, merges.size());
}

Minima RegionHierarchy::labels_after(std::size_t count) const {
  std::vector<std::uint32_t> label_of_basin(basin_count);
  std::iota(label_of_basin.begin(), label_of_basin.end(), 0u);
  for (std::size_t i = 0; i < count; ++i) label_of_basin[merges[i].b] = merges[i].a;  // always downwards
  std::uint32_t labels = 0;
  for (std::uint32_t basin = 0; basin < basin_count; ++basin) {
    const std::uint32_t into = label_of_basin[basin];
    label_of_basin[basin] = into == basin ? labels++ : label_of_basin[into];
  }
  Minima result{std::vector<std::uint32_t>(basin_of_vertex.size()), labels};
  for (std::size_t v = 0; v < basin_of_vertex.size(); ++v)
    result.label_of_vertex[v] = label_of_basin[basin_of_vertex[v]];
  return result;
}

RegionHierarchy build_hierarchy(const CornerTable& mesh, std::span<const Vec3> positions,
                                const Components& components, std::span<const ComponentShape> shapes,
                                const VertexMeasures& measures, std::span<const float> kappa, Minima basins,
                                const HierarchyOptions& options) {
  std::vector<double> area(basins.count, 0.0), component_area(basins.count, 0.0);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    area[basins.label_of_vertex[v]] += measures.area[v];
    component_area[basins.label_of_vertex[v]] = shapes[components.of_vertex[v]].area;
  }
  RegionGraph graph(mesh, basins.label_of_vertex, basins.count,
                    [&](CornerId c) { return measure_edge(mesh, positions, kappa, options.deepest, c); });
  Merger merger(std::move(graph), std::move(area), std::move(component_area), options);
  return {std::move(basins.label_of_vertex), basins.count, merger.run()};
}

}  // namespace selvage
