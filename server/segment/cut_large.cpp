// SPDX-License-Identifier: MIT
#include "server/segment/cut_large.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace selvage {
namespace {

/// Cuts one region after another, sharing arrays the size of the mesh.
class Cutter {
 public:
  Cutter(const Neighbours& neighbours, Minima& labels)
      : neighbours_(neighbours),
        labels_(labels),
        region_of_vertex_(labels.label_of_vertex),
        distance_(neighbours.vertex_count(), kNone) {}

  void cut(std::span<const VertexId> region, std::uint32_t pieces) {
    add_seed(region.front(), labels_.label_of_vertex[region.front()]);
    for (VertexId v : region) {
      if (distance_[v] == kNone) distance_[v] = 0;  // not connected to the first seed: keeps the label
    }
    fill_farthest(region);
    for (std::uint32_t piece = 1; piece < pieces; ++piece) {
      const VertexId seed = pop_farthest();
      if (seed == kNone) return;
      add_seed(seed, labels_.count++);
    }
  }

 private:
  /// Breadth first from a new seed inside its region, as far as it is nearer than all seeds before.
  void add_seed(VertexId seed, std::uint32_t label) {
    distance_[seed] = 0;
    labels_.label_of_vertex[seed] = label;
    queue_.assign(1, seed);
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      const std::uint32_t step = distance_[queue_[at]] + 1;
      for (VertexId u : neighbours_[queue_[at]]) {
        if (region_of_vertex_[u] != region_of_vertex_[seed] || distance_[u] <= step) continue;
        distance_[u] = step;
        labels_.label_of_vertex[u] = label;
        queue_.push_back(u);
      }
    }
  }

  void fill_farthest(std::span<const VertexId> region) {
    std::uint32_t farthest = 0;
    for (VertexId v : region) farthest = std::max(farthest, distance_[v]);
    at_distance_.assign(farthest + 1, {});
    for (VertexId v : region) at_distance_[distance_[v]].push_back(v);
  }

  /// kNone if all are seeds. Distances only shrink, so an entry out of date moves down when met.
  VertexId pop_farthest() {
    while (at_distance_.size() > 1) {
      auto& last = at_distance_.back();
      while (!last.empty()) {
        const VertexId v = last.back();
        last.pop_back();
        if (distance_[v] + 1 == at_distance_.size()) return v;
        at_distance_[distance_[v]].push_back(v);
      }
      at_distance_.pop_back();
    }
    return kNone;
  }

  const Neighbours& neighbours_;
  Minima& labels_;
  const std::vector<std::uint32_t> region_of_vertex_;  // before any cut
  std::vector<std::uint32_t> distance_;                // in edges, to the nearest seed of the region
  std::vector<VertexId> queue_;
  std::vector<std::vector<VertexId>> at_distance_;
};

}  // namespace

void cut_large_regions(const Neighbours& neighbours, Minima& labels, std::uint32_t max_vertices) {
  std::vector<std::uint32_t> begin(labels.count + 1, 0);
  for (std::uint32_t label : labels.label_of_vertex) ++begin[label + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<VertexId> vertices(labels.label_of_vertex.size());
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for (VertexId v = 0; v < vertices.size(); ++v) vertices[fill[labels.label_of_vertex[v]]++] = v;

  Cutter cutter(neighbours, labels);
  const double piece_size = std::max(1.0, 0.9 * max_vertices);
  for (std::size_t label = 0; label + 1 < begin.size(); ++label) {
    const std::uint32_t size = begin[label + 1] - begin[label];
    if (size <= max_vertices) continue;
    const auto pieces = static_cast<std::uint32_t>(std::ceil(size / piece_size));
    cutter.cut(std::span(vertices).subspan(begin[label], size), pieces);
  }
}

}  // namespace selvage
