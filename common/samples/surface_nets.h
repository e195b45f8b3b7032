// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/mesh/triangle_soup.h"
#include "common/samples/solid.h"

namespace selvage {

/// Meshes the surface of a solid on a grid of cubic cells, one vertex to a cell that the surface passes
/// through and two triangles to a grid edge [Gibson 1998, "Constrained elastic surface nets"]. Closed and
/// manifold; what is thinner than a cell or two may break or join. The surface must lie within the bounds.
TriangleSoup mesh_solid(Solid solid, const SolidBounds& bounds, double cell);

/// A cell size that gives about that many triangles, found by meshing coarsely first.
double cell_for_triangles(Solid solid, const SolidBounds& bounds, std::uint32_t triangles);

/// mesh_solid at that size, with vertices moved onto the surface and spread evenly: triangles as a scanner's
/// software gives, near equilateral, with no two alike.
TriangleSoup scan_solid(Solid solid, const SolidBounds& bounds, std::uint32_t about_triangles);

}  // namespace selvage
