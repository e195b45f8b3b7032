// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/render/rasterise.h"

namespace selvage {

/// Where the number of a region can be written: the visible point of it that is farthest from anything else.
struct LabelPlace {
  RegionId region;
  double x, y;  ///< in samples
  double room;  ///< samples from there to where the region ends
};

/// A place for each region that is seen anywhere, by region number; triangles of region kNone get none.
std::vector<LabelPlace> find_label_places(const VisibleTriangles& seen,
                                          std::span<const RegionId> region_of_triangle);

}  // namespace selvage
