// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// A partitioned model on its grid. Borrowed for the call that it is given to.
struct LevelSource {
  const CornerTable& mesh;               ///< passes check_corner_table
  std::span<const GridPoint> positions;  ///< by vertex
  std::span<const RegionId> region_of_vertex;
  std::uint32_t region_count = 0;
  std::span<const VertexId> pinned = {};  ///< copies that are welded again
};

}  // namespace selvage
