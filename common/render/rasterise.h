// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"
#include "common/render/camera.h"

namespace selvage {

/// Which triangle is seen at each sample, row by row from the top left.
struct VisibleTriangles {
  int width = 0, height = 0;
  std::vector<TriangleId> triangle;  ///< kNone where nothing is
  std::vector<float> nearness;       ///< see Projected; least float where nothing is

  TriangleId at(int x, int y) const { return triangle[static_cast<std::size_t>(y) * width + x]; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// Draws triangles into a depth buffer of width x height samples; `points` are in samples. Both sides of a
/// triangle are seen; of two at the same depth the first stays. A sample on an edge belongs to both
/// triangles, so no background shows between neighbours. Points that are not finite leave their triangles
/// out.
VisibleTriangles rasterise(std::span<const Projected> points, std::span<const Triangle> triangles, int width,
                           int height);

}  // namespace selvage
