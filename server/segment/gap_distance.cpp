// SPDX-License-Identifier: MIT
#include "server/segment/gap_distance.h"

#include <algorithm>

namespace selvage {
namespace {

/// Vertices waiting by distance. Buckets are taken in order; inside one the order does not matter, since a
/// vertex whose distance drops again is queued again. Distances only drop, so the result is exact.
class DistanceBuckets {
 public:
  explicit DistanceBuckets(float reach) : per_unit_(kBuckets / reach), buckets_(kBuckets + 1) {}

  void push(VertexId v, float distance) {
    buckets_[std::min(static_cast<std::size_t>(distance * per_unit_), kBuckets)].push_back({v, distance});
  }

  template <class Visit>
  void drain(Visit&& visit) {
    for (auto& bucket : buckets_) {
      for (std::size_t at = 0; at < bucket.size(); ++at) {
        const auto [v, distance] = bucket[at];  // by value: visiting may grow the bucket
        visit(v, distance);
      }
      std::vector<Entry>().swap(bucket);
    }
  }

 private:
  static constexpr std::size_t kBuckets = 256;
  struct Entry {
    VertexId vertex;
    float distance;
  };
  float per_unit_;
  std::vector<std::vector<Entry>> buckets_;
};

}  // namespace

std::vector<float> distance_to_plateau(const Neighbours& neighbours, std::span<const Vec3> positions,
                                       std::span<const std::uint8_t> is_plateau,
                                       std::span<const float> radius, float reach) {
  std::vector<float> distance(neighbours.vertex_count(), reach);
  if (!(reach > 0)) return distance;
  DistanceBuckets waiting(reach);
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    if (!is_plateau[v]) continue;
    distance[v] = 0;
    waiting.push(v, 0);
  }
  waiting.drain([&](VertexId v, float reached) {
    if (reached > distance[v]) return;  // a shorter way was found since
    for (VertexId u : neighbours[v]) {
      if (is_plateau[u]) continue;
      const float mean_radius = 0.5f * (radius[u] + radius[v]);
      const auto edge = static_cast<float>(length(positions[u] - positions[v]));
      const float candidate = reached + (mean_radius > 0 ? edge / mean_radius : 0);
      if (candidate >= distance[u]) continue;
      distance[u] = candidate;
      waiting.push(u, candidate);
    }
  });
  return distance;
}

}  // namespace selvage
