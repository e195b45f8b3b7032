// SPDX-License-Identifier: MIT
//
// Connected components of a mesh, their size, and which way their surface faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

struct Components {
  std::vector<std::uint32_t> of_vertex;     ///< component of each vertex, numbered by first vertex
  std::vector<std::uint32_t> vertex_count;  ///< by component

  std::uint32_t count() const { return static_cast<std::uint32_t>(vertex_count.size()); }
};

/// Practically linear time. A vertex without triangles is a component of its own.
Components find_components(const CornerTable& mesh);

struct ComponentShape {
  double area = 0;     ///< model units squared
  double outward = 1;  ///< -1 if the component is inside-out, that is if it encloses a negative volume
};

/// Area and orientation of each component. The volume is taken about one of the component's own vertices, so
/// that open components far from the origin are judged by their shape. Files with normals turned inwards are
/// common (horse.ply); without this every concave spot would count as convex and the other way round.
std::vector<ComponentShape> measure_components(const CornerTable& mesh, std::span<const Vec3> positions,
                                               const Components& components);

}  // namespace selvage
