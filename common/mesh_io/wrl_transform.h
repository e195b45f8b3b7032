// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/mesh/vec3.h"

namespace selvage {

/// About an axis through the origin, in radians, right-handed. An axis of length zero turns nothing.
struct WrlRotation {
  std::array<double, 4> axis_and_angle = {0, 0, 1, 0};

  Vec3 apply(const Vec3& p) const;
  WrlRotation inverse() const;
};

/// The fields of a VRML97 Transform node. ISO/IEC 14772-1, 6.52: P' = T * C * R * SR * S * -SR * -C * P.
struct WrlTransform {
  Vec3 translation, center, scale = {1, 1, 1};
  WrlRotation rotation, scale_orientation;

  Vec3 apply(const Vec3& p) const;
};

}  // namespace selvage
