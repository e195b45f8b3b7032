// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/mesh/triangle_soup.h"
#include "server/simplify/point_triangle.h"

namespace selvage::bench {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  double squared_distance(const Vec3& p) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max({low[axis] - p[axis], p[axis] - high[axis], 0.0});
      sum += d * d;
    }
    return sum;
  }
};

/// Nearest triangles of a soup by a tree of boxes, split at the median of the longest side.
class NearestTriangle {
 public:
  explicit NearestTriangle(const TriangleSoup& soup);

  /// The triangle nearest to p, and how far it is. Needs a soup with triangles. Not const: a search starts
  /// from the last one's result, as points come near one another.
  const PreparedTriangle& nearest(const Vec3& p);
  double distance(const Vec3& p) { return std::sqrt(nearest(p).squared_distance(p)); }

 private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::uint32_t left = 0, right = 0;  // 0: a leaf
  };

  std::uint32_t build(std::size_t begin, std::size_t end);

  std::vector<PreparedTriangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> stack_;
  std::size_t last_ = 0;
};

}  // namespace selvage::bench
