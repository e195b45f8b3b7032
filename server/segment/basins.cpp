// SPDX-License-Identifier: MIT
#include "server/segment/basins.h"

#include <algorithm>

#include "server/segment/erosion.h"
#include "server/segment/gap_distance.h"

namespace selvage {
namespace {

/// Vertices that seed basins: those far enough from the plateau, and whole basins that have none.
std::vector<std::uint8_t> choose_markers(const Minima& basins, const std::vector<float>& distance,
                                         float gap) {
  std::vector<std::uint8_t> has_far_vertex(basins.count, 0);
  for (std::size_t v = 0; v < distance.size(); ++v) {
    const std::uint32_t basin = basins.label_of_vertex[v];
    if (basin != kNone && distance[v] >= gap) has_far_vertex[basin] = 1;
  }
  std::vector<std::uint8_t> is_marker(distance.size(), 0);
  for (std::size_t v = 0; v < distance.size(); ++v) {
    const std::uint32_t basin = basins.label_of_vertex[v];
    is_marker[v] = basin != kNone && (distance[v] >= gap || !has_far_vertex[basin]);
  }
  return is_marker;
}

std::vector<std::uint8_t> inverse(std::vector<std::uint8_t> flags) {
  for (std::uint8_t& flag : flags) flag = !flag;
  return flags;
}

/// First in, first out at each of 256 levels over heights [0, 2]; never goes back below the current level.
class FloodQueue {
 public:
  void push(VertexId v, float height) {
    constexpr float kLevelsPerUnit = kLevels / 2.0f;
    const int level = std::clamp(static_cast<int>(height * kLevelsPerUnit), 0, kLevels - 1);
    queues_[std::max(level, current_)].push_back(v);
  }

  template <class Visit>
  void drain(Visit&& visit) {
    for (; current_ < kLevels; ++current_) {
      auto& queue = queues_[current_];
      for (std::size_t at = 0; at < queue.size(); ++at) visit(VertexId{queue[at]});
      std::vector<VertexId>().swap(queue);
    }
  }

 private:
  static constexpr int kLevels = 256;
  std::vector<std::vector<VertexId>> queues_{kLevels};
  int current_ = 0;
};

/// The label of the lowest labelled neighbour, the first of equally low ones.
std::uint32_t lowest_label(const Neighbours& neighbours, const std::vector<std::uint32_t>& label_of_vertex,
                           const std::vector<float>& height, VertexId v) {
  VertexId lowest = kNone;
  for (VertexId u : neighbours[v]) {
    if (label_of_vertex[u] != kNone && (lowest == kNone || height[u] < height[lowest])) lowest = u;
  }
  return label_of_vertex[lowest];
}

void flood(const Neighbours& neighbours, const std::vector<float>& height,
           std::vector<std::uint32_t>& label_of_vertex) {
  FloodQueue waiting;
  std::vector<bool> is_queued(neighbours.vertex_count(), false);
  const auto queue_unlabelled_neighbours = [&](VertexId v) {
    for (VertexId u : neighbours[v]) {
      if (label_of_vertex[u] != kNone || is_queued[u]) continue;
      is_queued[u] = true;
      waiting.push(u, height[u]);
    }
  };
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    if (label_of_vertex[v] != kNone) queue_unlabelled_neighbours(v);
  }
  waiting.drain([&](VertexId v) {
    label_of_vertex[v] = lowest_label(neighbours, label_of_vertex, height, v);
    queue_unlabelled_neighbours(v);
  });
}

}  // namespace

Minima flood_basins(const Neighbours& neighbours, std::span<const Vec3> positions, const HeightField& field,
                    const BasinOptions& options) {
  const auto tau = static_cast<float>(options.plateau_depth), gap = static_cast<float>(options.gap);
  std::vector<std::uint8_t> is_plateau(neighbours.vertex_count());
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) is_plateau[v] = field.kappa[v] < -tau;
  std::vector<float> height = distance_to_plateau(neighbours, positions, is_plateau, field.radius, gap);

  const Minima basins = label_minima(neighbours, is_plateau);
  Minima markers = label_minima(neighbours, inverse(choose_markers(basins, height, gap)));
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    height[v] = is_plateau[v] ? 1 - field.kappa[v] - tau : gap > 0 ? 1 - height[v] / gap : 0;
  }
  flood(neighbours, height, markers.label_of_vertex);
  erode_plateau(neighbours, markers);  // what no flood reached: components that are all plateau
  return markers;
}

}  // namespace selvage
