// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "common/codec/exact.h"
#include "common/mesh/boundary_loops.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// Marks a vertex that was cut from others at a non-manifold spot: all anchors of one group, in whatever
/// regions, are one vertex of the original. The stitcher welds those whose regions it has.
struct Anchor {
  VertexId vertex = 0;
  std::uint32_t group = 0;  ///< model-wide number
  friend bool operator==(const Anchor&, const Anchor&) = default;
};

/// A region as it travels: its interior triangles, a 2-manifold with boundary, in coding order.
struct RegionMesh {
  CornerTable table;
  std::vector<GridPoint> positions;  ///< by vertex
  std::vector<ExactPosition> exact;  ///< by vertex, in a bit-exact model; else empty
  std::vector<bool> is_turned;       ///< by triangle: the file had it the other way round. Empty: none is
  std::vector<Anchor> anchors;       ///< boundary vertices by boundary index, then others by number
  BoundaryLoops loops;               ///< what (region, boundary index) counts in; follows from `table`
};

}  // namespace selvage
