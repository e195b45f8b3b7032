// SPDX-License-Identifier: MIT
#include "server/segment/triangle_labels.h"

#include <algorithm>

namespace selvage {
namespace {

RegionId choose(RegionId a, RegionId b, RegionId c) {
  if (a != kLooseRegion && (a == b || a == c)) return a;
  if (b != kLooseRegion && b == c) return b;
  RegionId lowest = kNone;
  for (RegionId region : {a, b, c}) {
    if (region != kLooseRegion) lowest = std::min(lowest, region);
  }
  return lowest == kNone ? kLooseRegion : lowest;
}

}  // namespace

std::vector<RegionId> regions_of_triangles(const CornerTable& mesh, const Segmentation& segmentation) {
  std::vector<RegionId> regions(mesh.triangle_count());
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    const auto& region_of_vertex = segmentation.region_of_vertex;
    regions[t] = choose(region_of_vertex[a], region_of_vertex[b], region_of_vertex[c]);
  }
  return regions;
}

}  // namespace selvage
