// SPDX-License-Identifier: MIT
//
// What a sequence of collapses means for the triangles of the finest mesh: whole levels, and each region's
// share of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "server/simplify/simplify.h"

namespace selvage {

/// The triangles of `mesh` with corners replaced by their representatives, in order; those that then repeat a
/// vertex are left out. `source_of_triangle`, if given, receives the finest triangle of each.
std::vector<Triangle> substituted_triangles(const CornerTable& mesh,
                                            std::span<const VertexId> representative_of_vertex,
                                            std::vector<TriangleId>* source_of_triangle = nullptr);

/// At a level, the corner across the edge that corner c faces, whose triangle must be left: triangles that
/// are gone are passed through. kNone at the border. Says which triangles meet where vertices alone would
/// not: cut non-manifold edges share both.
CornerId corner_across(const CornerTable& mesh, std::span<const VertexId> representative_of_vertex,
                       CornerId c);

/// One region at one level. Its triangles, in the representatives of their corners, are an oriented manifold
/// with boundary in as many pieces as the finest region; its loops are those of the finest region with the
/// vertices that went left out, in the same order.
struct RegionLevel {
  /// Region triangles (three corners of this region) of the finest mesh that are left, ascending.
  std::vector<TriangleId> triangles;
  std::vector<VertexId> vertices;  ///< that are left, ascending; each one of the finest mesh
  double deviation = 0;            ///< largest of the region's collapses, in units of the positions
  /// The region has lost nothing since the level before: the two are the same.
  bool is_repeat = false;

  // Filled in by set_precisions and bound_deviations, for meshes on a grid.
  int dropped_bits = 0;  ///< low bits of coordinates that the level can do without
  double bound = 0;      ///< see level_bounds.h, in grid steps
};

struct LevelledMesh {
  /// By level, by vertex of the finest mesh; [0] maps every vertex to itself. Of a loop vertex the
  /// representative is on the same loop, and of a junction it is the vertex itself.
  std::vector<std::vector<VertexId>> representative_of_vertex;
  /// By level, by region; region 0 holds the loose vertices, which stay.
  std::vector<std::vector<RegionLevel>> regions;
};

/// Splits a labelled simplification by level and region. Levels come as in `simplification.levels`, the
/// finest first. `region_of_vertex` has ids up to `region_count`. Linear time a level.
LevelledMesh split_by_region(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                             std::uint32_t region_count, const Simplification& simplification);

/// The whole model with every region at a level of its own: what a client has after stitching.
/// `level_of_region` has a level for every region, 0 included.
std::vector<Triangle> mixed_triangles(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                                      const LevelledMesh& levels,
                                      std::span<const std::uint32_t> level_of_region);

}  // namespace selvage
