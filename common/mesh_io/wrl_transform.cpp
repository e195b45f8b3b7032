// SPDX-License-Identifier: MIT
#include "common/mesh_io/wrl_transform.h"

#include <cmath>

namespace selvage {

/// Rodrigues' formula.
Vec3 WrlRotation::apply(const Vec3& p) const {
  const auto& [x, y, z, angle] = axis_and_angle;
  const Vec3 axis = normalised({x, y, z});
  if (angle == 0 || axis == Vec3{}) return p;
  const double c = std::cos(angle), s = std::sin(angle);
  return p * c + cross(axis, p) * s + axis * (dot(axis, p) * (1 - c));
}

WrlRotation WrlRotation::inverse() const {
  const auto& [x, y, z, angle] = axis_and_angle;
  return {{x, y, z, -angle}};
}

Vec3 WrlTransform::apply(const Vec3& p) const {
  const Vec3 turned = scale_orientation.inverse().apply(p - center);
  const Vec3 scaled = {turned.x * scale.x, turned.y * scale.y, turned.z * scale.z};
  return rotation.apply(scale_orientation.apply(scaled)) + center + translation;
}

}  // namespace selvage
