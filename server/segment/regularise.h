// SPDX-License-Identifier: MIT
//
// Makes any labelling of the vertices codable. Branch pruning (dissertation section 4.2.5) was meant to do
// this, but one pass of it leaves regions that touch themselves in a vertex, fall apart, or have no triangle
// at all.
//
// A triangle is interior to region r if its three vertices are labelled r; every other is a boundary
// triangle. Regions are glued only along `opposite`, and only where both triangles are interior. Afterwards:
//   G1  every vertex is in exactly one region or loose;
//   G2  every vertex of a region has exactly one fan of that region's interior triangles, so the region is a
//       2-manifold with boundary; it is one edge-connected piece, or several where each is a whole component
//       of the mesh;
//   G3  hence a region's vertex that a boundary triangle touches lies exactly once on the region's boundary
//   loops,
//       and (region, boundary index) names it;
//   G4  every triangle is interior to one region or a boundary triangle;
//   G5  a vertex without interior triangle is loose.
// What remains allowed: several loops a region, handles, closed regions without a loop, regions of one
// triangle, boundary triangles with three labels, no region at all.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/segmentation.h"

namespace selvage {

struct RegulariseOptions {
  /// Components of the mesh with fewer vertices are dust: each stays whole whatever its labels, and
  /// neighbouring ones share a region until it has this many vertices. 0: nothing is dust.
  std::uint32_t min_component_vertices = 0;
  /// A label's second, third... edge-connected set becomes a region of its own from this size on, and
  /// dissolves into its neighbours below it. Triangles.
  std::uint32_t min_piece_triangles = 64;
  int max_rounds = 10;  ///< of dissolving; G1 to G5 hold after any number, more leave fewer vertices loose
};

/// Any labels will do: values mean nothing, vertices of equal label want to be together. Linear time and
/// memory apart from sorting labels and dust. `positions` only tell which dust lies together. Where
/// `part_of_vertex` is stated, dust keeps to it: components share a region only within a part, and a
/// component of several parts is no dust.
Segmentation regularise(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                        const RegulariseOptions& options, std::span<const Vec3> positions,
                        std::span<const std::uint32_t> part_of_vertex = {});

}  // namespace selvage
