// SPDX-License-Identifier: MIT
#include "server/simplify/strips.h"

#include <algorithm>
#include <map>

namespace selvage {

std::vector<Strip> find_strips(const CornerTable& mesh, std::span<const RegionId> region_of_vertex) {
  std::map<std::pair<RegionId, RegionId>, std::vector<TriangleId>> triangles_of_pair;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    const RegionId at_a = region_of_vertex[a], at_b = region_of_vertex[b], at_c = region_of_vertex[c];
    const auto [low, high] = std::minmax({at_a, at_b, at_c});
    const bool is_between_two = low != high && (at_a == low || at_a == high) &&
                                (at_b == low || at_b == high) && (at_c == low || at_c == high);
    if (is_between_two) triangles_of_pair[{low, high}].push_back(t);
  }
  std::vector<Strip> strips;
  for (auto& [pair, triangles] : triangles_of_pair)
    strips.push_back({pair.first, pair.second, std::move(triangles)});
  return strips;
}

}  // namespace selvage
