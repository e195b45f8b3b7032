// SPDX-License-Identifier: MIT
#include "common/mesh/corner_table.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace selvage {

void CornerTable::set_corner_of_vertex(std::uint32_t vertex_count) {
  corner_of_vertex.assign(vertex_count, kNone);
  for (CornerId c = 0; c < corner_count(); ++c) {
    // An open fan has exactly one corner without a clockwise neighbour; it wins over any other.
    if (CornerId& chosen = corner_of_vertex[vertex_of_corner[c]]; chosen == kNone || opposite[prev(c)] == kNone) {
      chosen = c;
    }
  }
}

CornerTable build_corner_table(std::span<const Triangle> triangles, std::uint32_t vertex_count) {
  CornerTable table;
  table.vertex_of_corner.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) table.vertex_of_corner.insert(table.vertex_of_corner.end(), t.begin(), t.end());
  table.opposite.assign(table.vertex_of_corner.size(), kNone);

  // Bucket the edges by their lower vertex (a counting sort), then match within a bucket, which is a one-ring.
  const auto ends = [&](CornerId c) {
    return std::pair{table.vertex_of_corner[next(c)], table.vertex_of_corner[prev(c)]};
  };
  std::vector<std::uint32_t> start_of_bucket(vertex_count + 1, 0);
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    const auto [tail, head] = ends(c);
    ++start_of_bucket[std::min(tail, head) + 1];
  }
  std::partial_sum(start_of_bucket.begin(), start_of_bucket.end(), start_of_bucket.begin());
  std::vector<CornerId> bucketed(table.corner_count());
  std::vector<std::uint32_t> fill(start_of_bucket.begin(), start_of_bucket.end() - 1);
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    const auto [tail, head] = ends(c);
    bucketed[fill[std::min(tail, head)]++] = c;
  }

  // Most buckets hold about three edges, so comparing all pairs beats hashing. A vertex of enormous valence
  // would make that quadratic: `first_at` remembers, per upper vertex, the first edge met in this bucket.
  std::vector<CornerId> first_at(vertex_count, kNone);
  std::vector<bool> is_spoilt(table.corner_count(), false);
  for (VertexId lower = 0; lower < vertex_count; ++lower) {
    const std::span bucket(bucketed.data() + start_of_bucket[lower], start_of_bucket[lower + 1] - start_of_bucket[lower]);
    for (CornerId c : bucket) {
      const auto [tail, head] = ends(c);
      CornerId& first = first_at[std::max(tail, head)];
      if (first == kNone) {
        first = c;
      } else if (table.opposite[first] == kNone && !is_spoilt[first] && ends(first).first == head) {
        table.opposite[first] = c;
        table.opposite[c] = first;
      } else {  // a third triangle at this edge, or two that run the same way: open on all sides
        is_spoilt[first] = true;
        if (const CornerId partner = table.opposite[first]; partner != kNone) {
          table.opposite[first] = table.opposite[partner] = kNone;
        }
      }
    }
    for (CornerId c : bucket) {
      const auto [tail, head] = ends(c);
      first_at[std::max(tail, head)] = kNone;
    }
  }
  table.set_corner_of_vertex(vertex_count);
  return table;
}

}  // namespace selvage
