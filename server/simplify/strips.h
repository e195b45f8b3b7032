// SPDX-License-Identifier: MIT
//
// Boundary triangles by the two regions that they lie between: what changes its shape with the levels of
// both. Triangles between three regions, and those of loose vertices alone, are the same at every level.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"

namespace selvage {

struct Strip {
  RegionId low, high;                 ///< low < high; low may be kLooseRegion
  std::vector<TriangleId> triangles;  ///< ascending
};

/// Ordered by (low, high).
std::vector<Strip> find_strips(const CornerTable& mesh, std::span<const RegionId> region_of_vertex);

}  // namespace selvage
