// SPDX-License-Identifier: MIT
//
// The canonical order of a region's boundary vertices, which is what `(region, boundary index)` counts in.
// Encoder and decoder both compute it from the decoded connectivity, so it costs no bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

/// Boundary loops one after another. Loops come in the order of their lowest vertex and start there; a loop
/// runs with the region on its left, that is along its triangles' own edge direction.
struct BoundaryLoops {
  std::vector<VertexId> vertices;      ///< by boundary index
  std::vector<std::uint32_t> lengths;  ///< vertices of each loop; they sum to vertices.size()
};

/// Linear time. Needs every vertex to have one fan (check_corner_table), so loops share no vertex.
BoundaryLoops find_boundary_loops(const CornerTable& table);

}  // namespace selvage
