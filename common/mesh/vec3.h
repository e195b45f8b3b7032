// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace selvage {

/// A point or a vector in model units.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  Vec3& operator+=(const Vec3& o) { x += o.x, y += o.y, z += o.z; return *this; }
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// `a` scaled to length 1, or zero where it has no direction.
inline Vec3 normalised(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}

/// A point on the model's integer grid. 24 bits an axis at most (see common/codec/quantizer.h), so sums and
/// differences of a few fit in 32 bits.
struct GridPoint {
  std::int32_t x = 0, y = 0, z = 0;

  std::int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  std::int32_t& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend GridPoint operator+(const GridPoint& a, const GridPoint& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend GridPoint operator-(const GridPoint& a, const GridPoint& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

}  // namespace selvage
