// SPDX-License-Identifier: MIT
#include "server/segment/average_plane.h"

namespace selvage {

AveragePlane average_plane(std::span<const Vec3> positions, VertexId v, const Ring& ring) {
  AveragePlane sum;
  double area_sum = 0;
  const Vec3 apex = positions[v];
  const auto add_face = [&](VertexId i, VertexId j) {
    const Vec3 area_vector = cross(positions[i] - apex, positions[j] - apex) * 0.5;
    const double area = length(area_vector);
    sum.normal += area_vector;
    sum.centre += (apex + positions[i] + positions[j]) * (area / 3);
    area_sum += area;
  };
  for (std::size_t i = 0; i + 1 < ring.vertices.size(); ++i) add_face(ring.vertices[i], ring.vertices[i + 1]);
  if (ring.is_closed && !ring.vertices.empty()) add_face(ring.vertices.back(), ring.vertices.front());
  if (!(area_sum > 0)) return {{}, apex};
  return {sum.normal * (1 / area_sum), sum.centre * (1 / area_sum)};
}

double signed_distance(std::span<const Vec3> positions, VertexId v, const Ring& ring) {
  const AveragePlane plane = average_plane(positions, v, ring);
  return dot(positions[v] - plane.centre, plane.normal);
}

}  // namespace selvage
