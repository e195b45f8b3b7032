// SPDX-License-Identifier: MIT
#include "server/segment/curvature.h"

#include <cmath>
#include <numbers>

namespace selvage {

double angle_at(const Vec3& apex, const Vec3& a, const Vec3& b) {
  const Vec3 to_a = a - apex, to_b = b - apex;
  return std::atan2(length(cross(to_a, to_b)), dot(to_a, to_b));
}

double angle_deficit(std::span<const Vec3> positions, VertexId v, const Ring& ring) {
  if (!ring.is_closed || ring.vertices.empty()) return 0;
  double sum = 0;
  VertexId before = ring.vertices.back();
  for (VertexId u : ring.vertices) {
    sum += angle_at(positions[v], positions[before], positions[u]);
    before = u;
  }
  return 2 * std::numbers::pi - sum;
}

double gaussian_curvature(std::span<const Vec3> positions, VertexId v, const Ring& ring) {
  if (!ring.is_closed || ring.vertices.empty()) return 0;
  double area = 0;
  VertexId before = ring.vertices.back();
  for (VertexId u : ring.vertices) {
    area += 0.5 * length(cross(positions[before] - positions[v], positions[u] - positions[v]));
    before = u;
  }
  return area > 0 ? 3 * angle_deficit(positions, v, ring) / area : 0;
}

}  // namespace selvage
