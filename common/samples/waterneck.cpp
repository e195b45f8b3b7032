// SPDX-License-Identifier: MIT
#include "common/samples/waterneck.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/samples/solid.h"
#include "common/samples/surface_nets.h"

namespace selvage {
namespace {

/// Flares from its waist towards both ends.
double neck(const Vec3& p) {
  const double from_waist = p.y - 1.05, radius = 0.39 + 0.20 * from_waist * from_waist;
  const double side = (std::hypot(p.x, p.z) - radius) / std::sqrt(1 + 0.16 * from_waist * from_waist);
  return std::max(side, std::abs(p.y - 0.95) - 0.58);
}

/// An oval ring in the x-y plane; body and neck hide the left of it.
double handle(const Vec3& p) {
  const double oval = ellipsoid({p.x, p.y, 0}, {0.76, 0.60, 0}, {0.66, 0.60, 1});
  return std::hypot(oval, p.z) - 0.115;
}

double spout(const Vec3& p) {
  static const std::array<TubePoint, 2> cone = {{{{-0.50, -0.22, 0}, 0.30}, {{-1.46, 0.80, 0}, 0.15}}};
  return tube(p, cone);
}

/// The disc at the end of the spout, square to it.
double rose(const Vec3& p) {
  constexpr double kAlongX = -0.6854, kAlongY = 0.7282;  // the direction of the spout
  const double x = p.x + 1.50, y = p.y - 0.84;
  return ellipsoid({x * kAlongX + y * kAlongY, x * kAlongY - y * kAlongX, p.z}, {}, {0.13, 0.30, 0.30});
}

double waterneck(const Vec3& p) {
  constexpr double kCrease = 0.04;
  double d = ellipsoid(p, {0, 0, 0}, {0.98, 0.80, 0.98});
  d = join(d, cylinder(p, -0.95, -0.60, 0.60, 0.08), kCrease);
  d = join(d, neck(p), kCrease);
  d = join(d, ring(p, 1.57, 0.46, 0.13), 2 * kCrease);  // else its underside leaves a cleft
  d = join(d, handle(p), kCrease);
  d = join(d, spout(p), kCrease);
  d = join(d, rose(p), kCrease);
  return cut(d, ellipsoid(p, {0, 1.72, 0}, {0.36, 0.48, 0.36}), kCrease);
}

}  // namespace

TriangleSoup make_waterneck(std::uint32_t about_triangles) {
  return scan_solid(waterneck, {{-1.85, -1.0, -1.05}, {1.6, 1.75, 1.05}}, about_triangles);
}

}  // namespace selvage
