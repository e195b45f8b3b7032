// SPDX-License-Identifier: MIT
//
// Which triangles become neighbours. `across[c]` is the corner that faces the same edge as corner c from the
// other side, kNone where the edge is open. Until triangles are turned (orient.h) the two sides may run the
// same way along their edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/edge_groups.h"

namespace selvage {

/// True if the triangles on both sides of the edge, as they are stored, run along it in opposite directions,
/// that is, are oriented alike.
inline bool runs_oppositely(std::span<const Triangle> triangles, CornerId side, CornerId other_side) {
  const auto tail_of = [&](CornerId c) { return triangles[triangle_of(c)][next(c) % 3]; };
  return tail_of(side) != tail_of(other_side);
}

/// Joins the two triangles at every edge that has exactly two, whichever way they run. All other edges are
/// open.
std::vector<CornerId> join_two_sided_edges(const EdgeGroups& edges, std::size_t corner_count);

/// At every edge with three or more triangles, joins as many disjoint pairs as run oppositely once turned,
/// those first that connect two pieces; the rest stays open. Returns how many edges have three or more
/// triangles.
///
/// Which triangles are paired is free, as the triangles come back the same; what counts is how many vertices
/// are then split. Measured as copies of vertices on defects/office_chair, bun_zipper_res2, pickup_big: all
/// such edges cut 416, 381, 541; paired within a piece first 210, 218, 257; in the order of the file 174, 92,
/// 85; pieces connected first, as here, 64, 64, 72.
std::uint32_t pair_crowded_edges(const EdgeGroups& edges, std::span<const Triangle> triangles,
                                 const std::vector<bool>& is_turned, std::span<CornerId> across);

}  // namespace selvage
