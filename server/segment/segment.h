// SPDX-License-Identifier: MIT
//
// Cuts a mesh into regions that are worth asking for: parts that a person would name. segment() lists the
// stages; each stage is a file of this folder.
//
// Classic mode is the dissertation's chapter 4 (Fig. 4.1): Gaussian curvature and concaveness on the XMR
// neighbourhood, thresholds, labelled minima, plateau erosion, merging by size and boundary length.
#pragma once

#include <cstdint>
#include <span>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/features.h"
#include "server/segment/regularise.h"
#include "server/segment/segmentation.h"

namespace selvage {

enum class SegmentMode {
  Classic,  ///< the dissertation's method
  Zhang,    ///< the same with Gaussian curvature alone, its comparison [Zhang et al. 2002]
};

struct SegmentOptions {
  SegmentMode mode = SegmentMode::Classic;
  int xmr_rings = 3;             ///< L of Def. 4.4 in edges, 1..5; others are clamped
  PlateauThresholds thresholds;  ///< Def. 4.5
  std::uint32_t min_region_vertices =
      0;                         ///< merge regions with fewer vertices; 0: 1 % of the mesh, at least 3
  bool prune_branches = false;   ///< run Table 4.4 before regularisation
  RegulariseOptions regularise;  ///< min_component_vertices 0: as many as min_region_vertices, 256 at most
};

/// Segments the mesh. `positions` has a finite point a vertex. The result is always codable (regularise.h)
/// and does not depend on the number of threads. Takes time proportional to triangles times L, apart from
/// merging and sorting.
Segmentation segment(const CornerTable& mesh, std::span<const Vec3> positions, const SegmentOptions& options,
                     const ParallelFor& parallel);

}  // namespace selvage
