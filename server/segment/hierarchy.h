// SPDX-License-Identifier: MIT
//
// The order in which basins grow together, from all of them to one a component. It replaces the
// dissertation's merging by vertex count (section 4.2.4): a border stays the longer the deeper it is and the
// narrower it is for the size of what it separates. Any prefix of the merges is a segmentation, so the number
// of regions can be chosen afterwards without computing anything again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/components.h"
#include "server/segment/height_field.h"
#include "server/segment/minima.h"
#include "server/segment/vertex_measures.h"

namespace selvage {

struct HierarchyOptions {
  double flat_border = 0.1;               ///< eps: what a border counts that is not concave at all
  double deepest = 0.4;                   ///< concavity of an edge is clamped to this
  double min_area_share = 0.005;          ///< of the component's area: smaller regions merge first
  std::uint32_t min_region_vertices = 0;  ///< regions with fewer vertices merge first
  std::uint32_t max_region_vertices =
      0;  ///< no merge makes a larger region, unless one side is below the minimum; 0: any
};

/// Regions a and b become one; it goes by the name a, the lower of the two.
struct RegionMerge {
  std::uint32_t a = 0, b = 0;
  /// (eps + c) (min(A_a, A_b) / l^2)^(1/4), where l is the border's length, c its mean concavity and A the
  /// regions' areas. Dimensionless; a thousandth of that if either region is too small.
  double saliency = 0;
};

/// Basins and all merges that are allowed, lowest saliency first at each step; equal ones by number.
struct RegionHierarchy {
  std::vector<std::uint32_t> basin_of_vertex;
  std::uint32_t basin_count = 0;
  std::vector<RegionMerge> merges;

  /// How many merges come before the first with a saliency above `stop`.
  std::size_t merges_below(double stop) const;
  /// How many merges leave `regions` regions; all of them where that few cannot be had.
  std::size_t merges_until(std::uint32_t regions) const;
  /// The labels 0..n-1 of the vertices after the first `count` merges, numbered by basin.
  Minima labels_after(std::size_t count) const;
};

/// O(B log B) for B basins beyond one pass over the mesh.
RegionHierarchy build_hierarchy(const CornerTable& mesh, std::span<const Vec3> positions,
                                const Components& components, std::span<const ComponentShape> shapes,
                                const VertexMeasures& measures, std::span<const float> kappa, Minima basins,
                                const HierarchyOptions& options);

}  // namespace selvage
