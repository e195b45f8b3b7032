// SPDX-License-Identifier: MIT
#include "server/segment/bending.h"

#include <array>
#include <cmath>

namespace selvage {
namespace {

constexpr int kDirections = 8;
constexpr double kMinShareOfRadius = 0.3;

using Ends = std::array<GeodesicEnd, kDirections>;

Vec3 normal_of(const Ends& ends, double min_length) {
  Vec3 sum;
  for (int j = 0; j < kDirections; ++j) {
    const GeodesicEnd &a = ends[j], &b = ends[(j + 1) % kDirections];
    if (a.length >= min_length && b.length >= min_length) sum += cross(a.way, b.way);
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

Bending measure_bending(const CornerTable& mesh, const GeodesicTracer& tracer, VertexId v, double radius,
                        double outward, GeodesicTracer::Scratch& scratch) {
  if (mesh.is_border_vertex(v) || !(radius > 0)) return {};
  Ends ends;
  tracer.shoot(v, radius, scratch, ends);
  const double min_length = kMinShareOfRadius * radius;
  const Vec3 normal = normal_of(ends, min_length) * outward;
  std::array<double, kDirections> q;
  for (int j = 0; j < kDirections; ++j) {
    const GeodesicEnd& opposite = ends[(j + kDirections / 2) % kDirections];
    const GeodesicEnd& end = ends[j].length >= min_length ? ends[j] : opposite;
    q[j] = end.length >= min_length ? -2 * radius * dot(end.way, normal) / (end.length * end.length) : 0;
  }
  return fourier(q);
}

}  // namespace selvage
