// SPDX-License-Identifier: MIT
//
// Finds the one-to-one map between the vertices of two meshes that carries triangles to triangles, for
// same_mesh. Three stages, each leaving less to the next:
//
//   1. A vertex with one candidate (near enough, same colour) is matched: there is no other way.
//   2. From matched vertices along edges: where both ends of an edge are matched and one triangle walks it,
//      the third vertex is given. On a manifold this floods everything that touches a matched edge.
//   3. What is left falls into clusters (coincident components, sheets that meet in a point, symmetric pieces
//      smaller than the tolerance). Each is searched: choose an image, follow stage 2, undo where it
//      contradicts. Clusters take the nearest place that is free; where that leaves one without, an
//      augmenting path of bipartite matching makes room. (Driving others out by nearness of one vertex
//      alone failed on STL files read without welding, at grids coarser than their slivers.)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/vec3.h"
#include "common/mesh/vertex_stars.h"

namespace selvage {

struct MatchSide {
  std::span<const Vec3> positions;
  const VertexStars& stars;
  const Colours& colours;
};

struct VertexMatching {
  enum class Verdict { Found, Impossible, Undecided };
  Verdict verdict = Verdict::Impossible;
  std::vector<VertexId> image_of_vertex;  ///< a's vertices to b's; kNone where unused or not found
  VertexId culprit = kNone;               ///< a vertex of a that has no image, if not Found
  bool culprit_has_candidates = false;  ///< something near `culprit` has its colour, but cannot be its image
};

/// Needs equally many vertices in use on both sides. Found means a one-to-one map within `tolerance`
/// whose triangles agree wherever the search went; the caller still checks all of them. Impossible is a
/// proof.
VertexMatching match_vertices(const MatchSide& a, const MatchSide& b, double tolerance);

}  // namespace selvage
