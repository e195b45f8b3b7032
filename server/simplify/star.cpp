// SPDX-License-Identifier: MIT
#include "server/simplify/star.h"

#include <algorithm>

namespace selvage {

std::uint32_t Star::place_of(VertexId v) const {
  const auto at = std::find(ring.begin(), ring.end(), v);
  return at == ring.end() ? kNone : static_cast<std::uint32_t>(at - ring.begin());
}

void Star::gather(const CornerTable& mesh, std::span<const Vec3> positions, VertexId v) {
  centre = v;
  centre_point = positions[v];
  corners.clear();
  ring.clear();
  points.clear();
  normals.clear();
  double_areas.clear();
  sum_of_double_areas = 0;

  const CornerId first = mesh.corner_of_vertex[v];
  CornerId c = first, last = first;
  do {
    corners.push_back(c);
    ring.push_back(mesh.vertex(next(c)));
    last = c;
    c = mesh.swing_ccw(c);
  } while (c != kNone && c != first);
  is_closed = c == first;
  if (!is_closed) ring.push_back(mesh.vertex(prev(last)));

  for (const VertexId neighbour : ring) points.push_back(positions[neighbour]);
  for (std::uint32_t i = 0; i < size(); ++i) {
    normals.push_back(cross(points[i] - centre_point, second_point(i) - centre_point));
    double_areas.push_back(length(normals.back()));
    sum_of_double_areas += double_areas.back();
  }
}

}  // namespace selvage
