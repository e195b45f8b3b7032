// SPDX-License-Identifier: MIT
#include "server/ingest/adjacency.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/base/disjoint_sets.h"

namespace selvage {
namespace {

void join(CornerId side, CornerId other_side, std::span<CornerId> across) {
  across[side] = other_side;
  across[other_side] = side;
}

/// The triangles that are connected so far.
DisjointSets pieces_of(std::span<const CornerId> across) {
  DisjointSets pieces(static_cast<std::uint32_t>(across.size() / 3));
  for (CornerId c = 0; c < across.size(); ++c) {
    if (across[c] != kNone) pieces.merge(triangle_of(c), triangle_of(across[c]));
  }
  return pieces;
}

/// Joins each of `fewer` to one of `more`, to one of another piece if there is one near the front.
void pair_up(std::span<const CornerId> fewer, std::span<CornerId> more, std::span<CornerId> across,
             DisjointSets& pieces) {
  constexpr std::size_t kLookAhead = 16;  // bounds the work at an edge with thousands of triangles
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    const std::span candidates = more.subspan(i, std::min(kLookAhead, more.size() - i));
    const auto partner = std::find_if(candidates.begin(), candidates.end(), [&](CornerId candidate) {
      return pieces.set_of(triangle_of(candidate)) != pieces.set_of(triangle_of(fewer[i]));
    });
    if (partner != candidates.end()) std::swap(*partner, candidates.front());
    join(fewer[i], candidates.front(), across);
    pieces.merge(triangle_of(fewer[i]), triangle_of(candidates.front()));
  }
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
  std::optional<DisjointSets> pieces;  // made for the first crowded edge: most files have none
  std::vector<CornerId> up, down;      // sides of one edge that run alike once turned
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    const std::span<const CornerId> sides = edges[edge];
    if (sides.size() < 3) continue;
    ++crowded_edges;
    if (!pieces) pieces = pieces_of(across);
    up.clear();
    down.clear();
    for (CornerId side : sides) {
      const bool is_as_first = !runs_oppositely(triangles, sides[0], side);
      (is_as_first != is_turned[triangle_of(side)] ? up : down).push_back(side);
    }
    if (up.size() > down.size()) std::swap(up, down);
    pair_up(up, down, across, *pieces);
  }
  return crowded_edges;
}

}  // namespace selvage
