// SPDX-License-Identifier: MIT
#include "common/mesh/grid.h"

#include <algorithm>

namespace selvage {

Grid make_grid(std::span<const Vec3> positions, int bits) {
  Grid grid{.bits = bits};
  if (positions.empty()) return grid;
  Vec3 low = positions[0], high = positions[0];
  for (const Vec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double step = side / grid.max_coordinate();
  grid.origin = low;
  // A side of denormal size, or one that overflows, has no usable step.
  grid.step = std::isnormal(step) ? step : 1;
  return grid;
}

}  // namespace selvage
