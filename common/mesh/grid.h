// SPDX-License-Identifier: MIT
//
// The model's one quantisation grid. All regions share it, so that they meet exactly.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "common/mesh/vec3.h"

namespace selvage {

inline constexpr int kMinGridBits = 8;
inline constexpr int kMaxGridBits = 24;

/// Maps model units to integers in [0, 2^bits) and back. Origin and step are float64 so that models far from
/// the origin (georeferenced scans) keep their precision.
struct Grid {
  Vec3 origin;
  double step = 1;  ///< model units between grid planes, > 0
  int bits = kMinGridBits;

  std::int32_t max_coordinate() const { return (std::int32_t{1} << bits) - 1; }

  /// The nearest grid point; at most half a step away on each axis for points inside the box the grid was made for.
  GridPoint quantise(const Vec3& p) const {
    return {nearest((p.x - origin.x) / step), nearest((p.y - origin.y) / step), nearest((p.z - origin.z) / step)};
  }
  Vec3 position(const GridPoint& g) const {
    return {origin.x + g.x * step, origin.y + g.y * step, origin.z + g.z * step};
  }

 private:
  std::int32_t nearest(double steps) const {
    const double last = max_coordinate();
    const double rounded = std::floor(steps + 0.5);
    return static_cast<std::int32_t>(rounded < 0 ? 0 : rounded > last ? last : rounded);
  }
};

/// The grid whose 2^bits planes span the longest side of the points' bounding box. A box without extent gets
/// step 1. Coordinates must be finite and `bits` within [kMinGridBits, kMaxGridBits].
Grid make_grid(std::span<const Vec3> positions, int bits);

}  // namespace selvage
