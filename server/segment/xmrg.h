// SPDX-License-Identifier: MIT
//
// XMR-G: the dissertation's idea (extended neighbourhood, hyperbolic or concave vertices as borders,
// watershed, region merging) with a radius instead of a ring count, one height instead of two thresholds, and
// a hierarchy instead of a vertex count. The measurements behind it are in docs/DECISIONS.md.
#pragma once

#include <cstdint>
#include <span>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/basins.h"
#include "server/segment/height_field.h"
#include "server/segment/hierarchy.h"
#include "server/segment/neighbours.h"

namespace selvage {

struct XmrgOptions {
  HeightFieldOptions height;
  BasinOptions basins;
  HierarchyOptions hierarchy;
  double stop_saliency = 0.18;  ///< borders at least this salient remain
  std::uint32_t target_regions =
      0;                ///< instead of stop_saliency: merge until this many are left; 0: use that
  bool smooth = false;  ///< smooth the borders at the end (smooth_labels.h)
};

/// Height field, basins and every merge: all that does not depend on how many regions are wanted.
struct XmrgHierarchy {
  HeightField field;
  RegionHierarchy regions;
};

XmrgHierarchy grow_xmrg_hierarchy(const CornerTable& mesh, const Neighbours& neighbours,
                                  std::span<const Vec3> positions, const XmrgOptions& options,
                                  const ParallelFor& parallel);

/// Labels by vertex, not yet codable: the hierarchy cut at the wanted place, large regions cut, borders
/// smoothed.
std::vector<std::uint32_t> xmrg_labels(const Neighbours& neighbours, const XmrgHierarchy& hierarchy,
                                       const XmrgOptions& options);

}  // namespace selvage
