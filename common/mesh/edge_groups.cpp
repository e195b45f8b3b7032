// SPDX-License-Identifier: MIT
#include "common/mesh/edge_groups.h"

#include <algorithm>
#include <numeric>

namespace selvage {
namespace {

/// A side of the bucket's edge towards `higher`: sorts by that vertex, then by corner.
using Side = std::uint64_t;

Side make_side(VertexId higher, CornerId corner) { return Side{higher} << 32 | corner; }
VertexId higher_of(Side side) { return static_cast<VertexId>(side >> 32); }
CornerId corner_of(Side side) { return static_cast<CornerId>(side); }

/// Calls visit(lower, higher, corner) for every side of every triangle, in the order of corners.
template <class Visit>
void for_each_side(std::span<const Triangle> triangles, Visit visit) {
  CornerId corner = 0;
  for (const auto& [a, b, c] : triangles) {
    visit(std::min(b, c), std::max(b, c), corner++);
    visit(std::min(c, a), std::max(c, a), corner++);
    visit(std::min(a, b), std::max(a, b), corner++);
  }
}

}  // namespace

EdgeGroups group_edges(std::span<const Triangle> triangles, std::uint32_t vertex_count) {
  // A counting sort by lower vertex, then a sort of each bucket, which is part of a one-ring: about three
  // edges. A vertex of enormous valence costs n log n, nothing worse.
  std::vector<std::uint32_t> end_of_bucket(vertex_count + std::size_t{1}, 0);
  for_each_side(triangles, [&](VertexId lower, VertexId, CornerId) { ++end_of_bucket[lower + 1]; });
  std::partial_sum(end_of_bucket.begin(), end_of_bucket.end(), end_of_bucket.begin());
  std::vector<Side> bucketed(3 * triangles.size());
  for_each_side(triangles, [&](VertexId lower, VertexId higher, CornerId corner) {
    bucketed[end_of_bucket[lower]++] = make_side(higher, corner);  // moves each start to its bucket's end
  });

  EdgeGroups edges;
  edges.sides_.reserve(bucketed.size());
  edges.end_of_edge_.reserve(bucketed.size() / 2 + 1);
  for (VertexId lower = 0; lower < vertex_count; ++lower) {
    const std::uint32_t start = lower == 0 ? 0 : end_of_bucket[lower - 1];
    const std::span bucket = std::span(bucketed).subspan(start, end_of_bucket[lower] - start);
    std::sort(bucket.begin(), bucket.end());
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      edges.sides_.push_back(corner_of(bucket[i]));
      const bool is_last_side = i + 1 == bucket.size() || higher_of(bucket[i]) != higher_of(bucket[i + 1]);
      if (is_last_side) edges.end_of_edge_.push_back(static_cast<std::uint32_t>(edges.sides_.size()));
    }
  }
  return edges;
}

}  // namespace selvage
