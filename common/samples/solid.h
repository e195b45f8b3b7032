// SPDX-License-Identifier: MIT
//
// Smooth solids as functions: negative inside, positive outside, growing about as fast as the distance to the
// surface. Solids are joined with a small blend, which leaves the concave crease that segmentation looks for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "common/mesh/vec3.h"

namespace selvage {

/// A solid to be meshed: called a few million times, so a plain function.
using Solid = double (*)(const Vec3&);

/// Where the solid lies, with a little air around it.
struct SolidBounds {
  Vec3 low, high;
};

/// The union of two solids, rounded over about `blend` where they meet; 0 leaves a sharp crease.
inline double join(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - (blend > 0 ? h * h / (4 * blend) : 0);
}

/// `a` with `b` cut out of it, the edge rounded over about `blend`.
inline double cut(double a, double b, double blend) { return -join(-a, b, blend); }

inline double sphere(const Vec3& p, const Vec3& centre, double radius) { return length(p - centre) - radius; }

/// Not quite a distance far from the surface, which is good enough near it.
inline double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 d = p - centre;
  const double k = length({d.x / radii.x, d.y / radii.y, d.z / radii.z});
  const double g = length({d.x / (radii.x * radii.x), d.y / (radii.y * radii.y), d.z / (radii.z * radii.z)});
  return g > 0 ? k * (k - 1) / g : -std::min({radii.x, radii.y, radii.z});
}

/// A ring around the y axis at height `y`.
inline double ring(const Vec3& p, double y, double radius, double thickness) {
  return std::hypot(std::hypot(p.x, p.z) - radius, p.y - y) - thickness;
}

/// A cylinder around the y axis from `low` to `high`, its rims rounded by `rim`.
inline double cylinder(const Vec3& p, double low, double high, double radius, double rim) {
  const double out = std::hypot(p.x, p.z) - radius + rim;
  const double past = std::abs(p.y - (low + high) / 2) - (high - low) / 2 + rim;
  return std::hypot(std::max(out, 0.0), std::max(past, 0.0)) + std::min(std::max(out, past), 0.0) - rim;
}

struct TubePoint {
  Vec3 at;
  double radius;
};

/// A round tube along a polyline whose radius changes from point to point.
inline double tube(const Vec3& p, std::span<const TubePoint> points) {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 along = points[i + 1].at - points[i].at, d = p - points[i].at;
    const double t = std::clamp(dot(d, along) / dot(along, along), 0.0, 1.0);
    const double radius = points[i].radius + t * (points[i + 1].radius - points[i].radius);
    nearest = std::min(nearest, length(d - along * t) - radius);
  }
  return nearest;
}

}  // namespace selvage
