// SPDX-License-Identifier: MIT
#include "server/simplify/quadrics.h"

#include <algorithm>

namespace selvage {

Quadrics::Quadrics(const CornerTable& mesh, std::span<const Vec3> positions)
    : positions_(positions), quadric_of_vertex_(mesh.vertex_count(), Quadric{}) {
  if (!positions.empty()) origin_ = positions[0];
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const Vec3& a = positions[mesh.vertex(c)];
    const Vec3& b = positions[mesh.vertex(next(c))];
    const Vec3& d = positions[mesh.vertex(prev(c))];
    const Vec3 normal = cross(b - a, d - a);
    const Vec3 unit = normalised(normal);
    add_plane(mesh.vertex(c), unit, a, length(normal) / 2);
    if (mesh.opposite[c] != kNone) continue;
    const Vec3 edge = d - b;
    for (const VertexId v : {mesh.vertex(next(c)), mesh.vertex(prev(c))}) {
      add_plane(v, normalised(cross(edge, unit)), b, dot(edge, edge));
    }
  }
}

void Quadrics::add_plane(VertexId v, const Vec3& n, const Vec3& through, double weight) {
  const double offset = -dot(n, through - origin_);
  const Quadric plane = {n.x * n.x, n.x * n.y,    n.x * n.z,    n.y * n.y,    n.y * n.z,
                         n.z * n.z, n.x * offset, n.y * offset, n.z * offset, offset * offset};
  for (std::size_t i = 0; i < plane.size(); ++i) quadric_of_vertex_[v][i] += weight * plane[i];
}

double Quadrics::cost(VertexId u, VertexId v) const {
  const Vec3 p = positions_[v] - origin_;
  const std::array<double, 10> terms = {p.x * p.x, 2 * p.x * p.y, 2 * p.x * p.z, p.y * p.y, 2 * p.y * p.z,
                                        p.z * p.z, 2 * p.x,       2 * p.y,       2 * p.z,   1};
  double error = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    error += (quadric_of_vertex_[u][i] + quadric_of_vertex_[v][i]) * terms[i];
  }
  return std::max(error, 0.0);  // rounding may take it below
}

void Quadrics::collapse(VertexId u, VertexId v) {
  for (std::size_t i = 0; i < 10; ++i) quadric_of_vertex_[v][i] += quadric_of_vertex_[u][i];
}

}  // namespace selvage
