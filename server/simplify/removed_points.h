// SPDX-License-Identifier: MIT
//
// The vertices that collapses have removed, each on the triangle that it was nearest to: what the deviation
// of the simplified surface is measured at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/vec3.h"
#include "server/simplify/point_triangle.h"
#include "server/simplify/star.h"

namespace selvage {

/// Two arrays hold all lists: the first point of every triangle, the next one of every removed vertex.
class RemovedPoints {
 public:
  RemovedPoints(std::uint32_t triangle_count, std::span<const Vec3> positions)
      : positions_(positions),
        first_of_triangle_(triangle_count, kNone),
        next_of_vertex_(positions.size(), kNone) {}

  /// The squared deviation that collapsing the star's centre to `place` would leave: the largest squared
  /// distance from the centre, and from each point on the star's triangles, to the nearest new triangle; and
  /// from the middle of each new edge to the nearest old one, which sees bridges over valleys where no vertex
  /// lies. Not a bound: the true distance was 1.0 to 1.6 times as large, once 2.0.
  double squared_deviation(const Star& star, std::uint32_t place);

  /// Puts the centre and all points on the star's triangles on the nearest triangle after the collapse.
  void collapse(const Star& star, std::uint32_t place);

 private:
  void prepare_new_triangles(const Star& star, std::uint32_t place);
  double farthest_edge_middle(const Star& star, std::uint32_t place, double at_least);

  std::span<const Vec3> positions_;
  std::vector<std::uint32_t> first_of_triangle_, next_of_vertex_;
  // Scratch: the triangles after the collapse, and which of the star's they are.
  std::vector<PreparedTriangle> new_triangles_, old_triangles_;
  std::vector<std::uint32_t> index_in_star_;
};

}  // namespace selvage
