// SPDX-License-Identifier: MIT
#include "server/segment/partition.h"

#include <numeric>

#include "server/segment/pieces.h"

namespace selvage {

Partition make_partition(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                         std::uint32_t region_count) {
  Partition partition;
  partition.region_count = region_count;
  partition.region_of_vertex.assign(region_of_vertex.begin(), region_of_vertex.end());
  auto& begin = partition.region_triangles_begin;
  begin.assign(region_count + 2, 0);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (is_interior(mesh, region_of_vertex, t, kLooseRegion)) {
      ++begin[region_of_vertex[mesh.vertex(3 * t)] + 1];
    } else {
      partition.boundary_triangles.push_back(t);
    }
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  partition.region_triangles.resize(begin.back());
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (!is_interior(mesh, region_of_vertex, t, kLooseRegion)) continue;
    partition.region_triangles[fill[region_of_vertex[mesh.vertex(3 * t)]]++] = t;
  }
  return partition;
}

}  // namespace selvage
