// SPDX-License-Identifier: MIT
//
// The dissertation's pipeline (chapter 4, Fig. 4.1) and the two methods that it compares itself with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/features.h"

namespace selvage {

struct ClassicOptions {
  int xmr_rings = 3;             ///< L of Def. 4.4, in edges; clamped to 1..5
  PlateauThresholds thresholds;  ///< Def. 4.5
  bool prune_branches = false;   ///< run Table 4.4 at the end
};

/// Labels by vertex, not yet codable: features, thresholds, minima, erosion, merging of regions with fewer
/// than `min_region_vertices` vertices. thresholds.use_distance = false makes it Zhang's method.
std::vector<std::uint32_t> classic_labels(const CornerTable& mesh, std::span<const Vec3> positions,
                                          const ClassicOptions& options, std::uint32_t min_region_vertices,
                                          const ParallelFor& parallel);

/// The same basins, but merged by depth [Mangan and Whitaker 1999] until `target_regions` are left; 0: as
/// many as classic_labels would leave. The height is minus the signed distance, in model units, as in the
/// simulation of section 4.3.3: deepest where the surface is most convex.
std::vector<std::uint32_t> mangan_whitaker_labels(const CornerTable& mesh, std::span<const Vec3> positions,
                                                  const ClassicOptions& options,
                                                  std::uint32_t min_region_vertices,
                                                  std::uint32_t target_regions, const ParallelFor& parallel);

}  // namespace selvage
