// SPDX-License-Identifier: MIT
#include "server/segment/bending.h"

#include <array>
#include <cmath>
#include <numbers>

#include "server/segment/curvature.h"
#include "server/segment/one_ring.h"

namespace selvage {
namespace {

constexpr int kDirections = 8;
constexpr double kMinShareOfRadius = 0.3;

using Ends = std::array<GeodesicEnd, kDirections>;  // points relative to the vertex

/// The angle of all triangles at v, radians.
double fan_angle(const CornerTable& mesh, std::span<const Vec3> positions, VertexId v) {
  double sum = 0;
  for_each_corner_at(mesh, v, [&](CornerId c) {
    sum += angle_at(positions[v], positions[mesh.vertex(next(c))], positions[mesh.vertex(prev(c))]);
  });
  return sum;
}

Ends shoot(const CornerTable& mesh, std::span<const Vec3> positions, const GeodesicTracer& tracer, VertexId v,
           double radius) {
  Ends ends;
  const double step = fan_angle(mesh, positions, v) / kDirections;
  int shot = 0;
  double begin = 0;  // of the current triangle's angle
  for_each_corner_at(mesh, v, [&](CornerId c) {
    const double end =
        begin + angle_at(positions[v], positions[mesh.vertex(next(c))], positions[mesh.vertex(prev(c))]);
    for (; shot < kDirections && (shot + 0.5) * step < end; ++shot) {
      ends[shot] = tracer.trace(c, (shot + 0.5) * step - begin, radius);
      ends[shot].point = ends[shot].point - positions[v];
    }
    begin = end;
  });
  return ends;  // any direction lost to rounding stays at length 0, which is not valid
}

Vec3 normal_of(const Ends& ends, double min_length) {
  Vec3 sum;
  for (int j = 0; j < kDirections; ++j) {
    const GeodesicEnd &a = ends[j], &b = ends[(j + 1) % kDirections];
    if (a.length >= min_length && b.length >= min_length) sum += cross(a.point, b.point);
  }
  return normalised(sum);
}

Bending fourier(const std::array<double, kDirections>& q) {
  double mean = 0, cosine = 0, sine = 0;
  for (int j = 0; j < kDirections; ++j) {
    // cos and sin of 4 pi j / 8: quarter turns.
    constexpr double kCos[4] = {1, 0, -1, 0}, kSin[4] = {0, 1, 0, -1};
    mean += q[j];
    cosine += q[j] * kCos[j % 4];
    sine += q[j] * kSin[j % 4];
  }
  return {mean / kDirections, 2.0 / kDirections * std::sqrt(cosine * cosine + sine * sine)};
}

}  // namespace

Bending measure_bending(const CornerTable& mesh, std::span<const Vec3> positions,
                        const GeodesicTracer& tracer, VertexId v, double radius, double outward) {
  if (mesh.is_border_vertex(v) || !(radius > 0)) return {};
  const Ends ends = shoot(mesh, positions, tracer, v, radius);
  const double min_length = kMinShareOfRadius * radius;
  const Vec3 normal = normal_of(ends, min_length) * outward;
  std::array<double, kDirections> q;
  for (int j = 0; j < kDirections; ++j) {
    const GeodesicEnd& opposite = ends[(j + kDirections / 2) % kDirections];
    const GeodesicEnd& end = ends[j].length >= min_length ? ends[j] : opposite;
    q[j] = end.length >= min_length ? -2 * radius * dot(end.point, normal) / (end.length * end.length) : 0;
  }
  return fourier(q);
}

}  // namespace selvage
