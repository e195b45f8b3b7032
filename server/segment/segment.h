// SPDX-License-Identifier: MIT
//
// Cuts a mesh into regions that are worth asking for: parts that a person would name. Each mode turns the
// mesh into labels (xmrg.h, classic.h), then regularise.h makes the labels codable. Each stage is a file of
// this folder.
#pragma once

#include <cstdint>
#include <span>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/classic.h"
#include "server/segment/regularise.h"
#include "server/segment/segmentation.h"
#include "server/segment/xmrg.h"

namespace selvage {

enum class SegmentMode {
  Xmrg,            ///< height field by geodesic radius, watershed, hierarchy; the default
  Classic,         ///< the dissertation's method
  Zhang,           ///< the same with Gaussian curvature alone [Zhang et al. 2002]
  ManganWhitaker,  ///< the dissertation's basins merged by depth [Mangan and Whitaker 1999]
  Cad,             ///< Xmrg that also cuts at sharp convex edges
};

struct SegmentOptions {
  SegmentMode mode = SegmentMode::Xmrg;

  /// Number of regions before large ones are cut and dust is grouped; 0: as many as the shape has. Not below
  /// the number of components. Xmrg, Cad, ManganWhitaker.
  std::uint32_t target_regions = 0;
  /// Smaller regions merge, in vertices. 0: Xmrg and Cad go by area alone, the others take 1 % of the mesh,
  /// at least 3.
  std::uint32_t min_region_vertices = 0;
  /// Larger regions are cut, in vertices; 0: none is too large. Xmrg and Cad.
  std::uint32_t max_region_vertices = 0;
  bool smooth = false;  ///< Xmrg and Cad: smooth the borders

  int xmr_rings = 3;             ///< Classic, Zhang, ManganWhitaker: L of Def. 4.4 in edges, clamped to 1..5
  PlateauThresholds thresholds;  ///< the same: Def. 4.5
  bool prune_branches = false;   ///< the same: run Table 4.4 before regularisation

  HeightFieldOptions height;    ///< Xmrg and Cad
  BasinOptions basins;          ///< Xmrg and Cad
  HierarchyOptions hierarchy;   ///< Xmrg and Cad; its limits on vertices are taken from above
  double stop_saliency = 0.18;  ///< Xmrg and Cad: borders at least this salient remain

  RegulariseOptions
      regularise;  ///< min_component_vertices 0: min_region_vertices or its usual value, 256 at most
};

/// The options with regions sized for streaming on models of more than 20,000 triangles: 384 to 4096 vertices
/// where the options do not say otherwise, one that they say setting bounds to the other, and smooth borders.
/// Smaller models stay as they are, as do options that ask for a number of regions, and modes that do not
/// know sizes.
SegmentOptions with_streaming_sizes(SegmentOptions options, std::uint32_t triangle_count);

/// Segments the mesh. `positions` has a finite point a vertex. The result is always codable (regularise.h)
/// and does not depend on the number of threads. Linear time and memory apart from sorting and merging
/// basins.
Segmentation segment(const CornerTable& mesh, std::span<const Vec3> positions, const SegmentOptions& options,
                     const ParallelFor& parallel);

/// The options of the xmrg stages that segment() runs with, for callers that want the hierarchy itself.
XmrgOptions xmrg_options(const SegmentOptions& options);

}  // namespace selvage
