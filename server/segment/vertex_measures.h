// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// By vertex, in model units (squared). 0 for a vertex without triangles.
struct VertexMeasures {
  std::vector<float> area;       ///< a third of the triangles at the vertex
  std::vector<float> mean_edge;  ///< mean length of the edges at the vertex
};

VertexMeasures measure_vertices(const CornerTable& mesh, std::span<const Vec3> positions);

}  // namespace selvage
