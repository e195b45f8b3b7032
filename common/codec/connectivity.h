// SPDX-License-Identifier: MIT
//
// From the grown triangles to a region's final connectivity: the steps between connectivity and geometry that
// encoder and decoder share.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

struct Connectivity {
  CornerTable table;
  /// Corners keep their place: corner k of triangle t was 3 * grown + k. Empty if no triangle was dropped.
  std::vector<TriangleId> grown_of_triangle;
};

/// A region's boundary loops other than its outer one are coded as if closed by a fan around a virtual
/// vertex. Takes those fans away again. Nothing if the virtual vertices are not ascending, out of range, or
/// not inside the mesh: the stream is corrupt. Leaves corner_of_vertex behind the times: for GeometryWalk, a
/// vertex is a fan.
std::optional<Connectivity> finish_connectivity(CornerTable grown,
                                                std::span<const VertexId> virtual_vertices);

}  // namespace selvage
