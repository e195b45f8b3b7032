// SPDX-License-Identifier: MIT
#include "common/samples/dumbbell.h"

#include <cmath>

#include "common/samples/solid.h"
#include "common/samples/surface_nets.h"

namespace selvage {
namespace {

double dumbbell(const Vec3& p) {
  const double bar = std::max(std::hypot(p.y, p.z) - 0.36, std::abs(p.x) - 1.6);
  const double ball = sphere({std::abs(p.x), p.y, p.z}, {1.6, 0, 0}, 1.0);
  return join(bar, ball, 0.06);
}

}  // namespace

TriangleSoup make_dumbbell(std::uint32_t about_triangles) {
  return scan_solid(dumbbell, {{-2.75, -1.15, -1.15}, {2.75, 1.15, 1.15}}, about_triangles);
}

}  // namespace selvage
