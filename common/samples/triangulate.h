// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/mesh/triangle_soup.h"

namespace selvage {

struct Point2 {
  double x = 0, y = 0;
};

/// Triangulates a polygon with holes and returns triangles over the points of all loops in order,
/// counter-clockwise. The outer loop comes first and runs counter-clockwise, holes run clockwise; loops
/// neither touch nor cross. Ear clipping with bridges to the holes [Eberly 2002], then flips to Delaunay.
/// Quadratic: for faces of some thousands of points.
std::vector<Triangle> triangulate(std::span<const std::vector<Point2>> loops);

}  // namespace selvage
