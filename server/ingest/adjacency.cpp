// SPDX-License-Identifier: MIT
#include "server/ingest/adjacency.h"

#include <algorithm>

namespace selvage {
namespace {

void join(CornerId side, CornerId other_side, std::span<CornerId> across) {
  across[side] = other_side;
  across[other_side] = side;
}

}  // namespace

std::vector<CornerId> join_two_sided_edges(const EdgeGroups& edges, std::size_t corner_count) {
  std::vector<CornerId> across(corner_count, kNone);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    if (const auto sides = edges[edge]; sides.size() == 2) join(sides[0], sides[1], across);
  }
  return across;
}

std::uint32_t pair_crowded_edges(const EdgeGroups& edges, std::span<const Triangle> triangles,
                                 const std::vector<bool>& is_turned, std::span<CornerId> across) {
  std::uint32_t crowded_edges = 0;
  std::vector<CornerId> up, down;  // sides of one edge that run alike once turned
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    const std::span<const CornerId> sides = edges[edge];
    if (sides.size() < 3) continue;
    ++crowded_edges;
    up.clear();
    down.clear();
    for (CornerId side : sides) {
      const bool is_as_first = !runs_oppositely(triangles, sides[0], side);
      (is_as_first != is_turned[triangle_of(side)] ? up : down).push_back(side);
    }
    for (std::size_t i = 0; i < std::min(up.size(), down.size()); ++i) join(up[i], down[i], across);
  }
  return crowded_edges;
}

}  // namespace selvage
