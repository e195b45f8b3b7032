// SPDX-License-Identifier: MIT
//
// Small meshes with known topology, for tests. All are oriented outwards.
#pragma once

#include "common/mesh/triangle_soup.h"

namespace selvage::shapes {

TriangleSoup triangle();
TriangleSoup tetrahedron();                   ///< closed, genus 0
TriangleSoup grid(int columns, int rows);     ///< flat, open: one loop; 2 * columns * rows triangles
TriangleSoup grid_with_holes(int columns, int rows, int holes);  ///< single cells left out along the diagonal, none touching
TriangleSoup torus(int around, int along);    ///< closed, genus 1; 2 * around * along triangles
TriangleSoup sphere(int subdivisions);        ///< subdivided octahedron, 8 * 4^n triangles
TriangleSoup open_cylinder(int around, int along);  ///< two loops
TriangleSoup mobius_strip(int along);         ///< not orientable
/// A torus with `extra` more handles: a chain of genus extra + 1, closed.
TriangleSoup chain_of_tori(int extra);

/// Appends a mesh as further components.
void append(TriangleSoup& to, const TriangleSoup& other);
TriangleSoup translated(TriangleSoup soup, const Vec3& by);

}  // namespace selvage::shapes
