// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/result.h"
#include "common/codec/exact.h"
#include "common/mesh/boundary_loops.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// Marks a vertex that was cut from others at a non-manifold spot: all anchors of one group, in whatever
/// regions, are one vertex of the original. The stitcher welds those whose regions it has.
struct Anchor {
  VertexId vertex = 0;
  std::uint32_t group = 0;  ///< model-wide number
  friend bool operator==(const Anchor&, const Anchor&) = default;
};

/// A region at one level of detail, as it travels: its interior triangles, a 2-manifold with boundary, in
/// coding order.
struct RegionMesh {
  std::vector<Triangle> triangles;
  /// By vertex, on the model's grid whatever the level: one that leaves low bits out gives the middles of its
  /// cells, so vertices of different levels need no conversion.
  std::vector<GridPoint> positions;
  std::vector<ExactPosition> exact;  ///< by vertex, at the finest level of a bit-exact model; else empty
  std::vector<bool> is_turned;       ///< by triangle: the file had it the other way round. Empty: none is
  std::vector<Anchor> anchors;       ///< boundary vertices by boundary index, then others by number
  /// Of this level. They follow from how the triangles are joined, which is not always said by their
  /// vertices: an edge may be there twice.
  BoundaryLoops loops;
  /// What (region, boundary index) means: by boundary index, which always counts the finest level's loops,
  /// the vertex of this level that stands for it. The finest level's is loops.vertices; on a coarser one
  /// neighbours on a loop may share a vertex, and a boundary triangle with two corners in one vertex is gone.
  std::vector<VertexId> vertex_of_boundary;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size()); }
};

/// Checks what every decoded region owes: triangles are a 2-manifold with boundary, every vertex in one fan,
/// its border exactly the loops, in canonical order; whatever is told by vertex or triangle is told of each,
/// and of none else. A BadStream error names the first violation. For tests and for `verify`, not for hot
/// paths.
Result<void> check_region_mesh(const RegionMesh& mesh);

}  // namespace selvage
