// SPDX-License-Identifier: MIT
//
// A segmented mesh as the encoders take it: which triangles each region codes, and which go into joins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"

namespace selvage {

struct Partition {
  std::uint32_t region_count = 0;          ///< real regions; ids are 1..region_count
  std::vector<RegionId> region_of_vertex;  ///< kLooseRegion for loose vertices
  /// Interior triangles (three vertices in one real region), grouped by region, ascending inside a region.
  std::vector<TriangleId> region_triangles;
  /// By region, where its triangles begin; region_count + 2 entries, so that r + 1 is the end. Region 0 has
  /// none.
  std::vector<std::uint32_t> region_triangles_begin;
  std::vector<TriangleId> boundary_triangles;  ///< every other triangle, ascending

  std::span<const TriangleId> triangles_of(RegionId region) const {
    return std::span(region_triangles)
        .subspan(region_triangles_begin[region],
                 region_triangles_begin[region + 1] - region_triangles_begin[region]);
  }
};

/// Sorts the triangles by region. `region_of_vertex` has a region a vertex, all <= region_count. Linear time.
/// The result is as codable as the labels are: regularise() makes them so, check_partition() tells.
Partition make_partition(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                         std::uint32_t region_count);

}  // namespace selvage
