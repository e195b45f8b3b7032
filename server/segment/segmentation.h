// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/ids.h"

namespace selvage {

/// Which region every vertex belongs to. Always codable: see regularise.h for what that guarantees.
struct Segmentation {
  std::vector<RegionId> region_of_vertex;  ///< kLooseRegion (0) = loose, real regions are 1..region_count
  std::uint32_t region_count = 0;          ///< real regions, numbered by first vertex
  std::uint32_t loose_vertex_count = 0;
};

}  // namespace selvage
