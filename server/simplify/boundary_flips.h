// SPDX-License-Identifier: MIT
//
// The test by normals for collapses along region borders, against levels of the neighbour other than the
// current one.
//
// Why: where two regions' loops turn together, on a crease or around a corner, both may be straightened
// without a trace. Against a neighbour that has stayed fine the straight loop cuts across the bends, and
// boundary triangles fold over. bridge_links.h says why the levels published so far are all that matter; its
// argument makes this as strong as the test on the mesh in hand.
//
// That is asked for the level before, so neighbours whose levels differ by one do not fold. Against levels
// farther off a small triangle may be turned over flat, so that it overlaps its neighbours within the
// surface, but not turned up out of it: forbidding that as well blocked two thirds of the loop vertices that
// bunny had at a sixteenth of its triangles, and starved the insides of its regions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/simplify/gathered_lists.h"

namespace selvage {

class BoundaryFlips {
 public:
  /// `region_of_vertex` is empty (no borders, no memory) or has a label a vertex. Borrows all three.
  /// `mean_area` is that of the mesh's triangles.
  BoundaryFlips(const CornerTable& mesh, std::span<const Vec3> positions,
                std::span<const RegionId> region_of_vertex, double mean_area);

  /// Whether u, all of whose neighbours in other regions are in one region, may go to v: no boundary triangle
  /// turns by 78 degrees or more with that region at the last of `published`, which are representatives by
  /// vertex (the finest level if there are none); and at those before none but small ones, by 102 or more.
  bool keep_normals(VertexId u, VertexId v, std::span<const std::vector<VertexId>> published);

  void collapse(VertexId u, VertexId v);

 private:
  struct Neighbour {
    std::span<const VertexId> representative_of_vertex;  ///< empty: at its finest
    bool is_near;                                        ///< its level is the one before
  };

  VertexId current(VertexId v);
  bool keeps_normal(TriangleId t, VertexId u, VertexId v, const Neighbour& neighbour);

  const CornerTable& mesh_;
  std::span<const Vec3> positions_;
  std::span<const RegionId> region_of_vertex_;
  double mean_area_;
  std::vector<VertexId> next_on_way_;    ///< by vertex: where it went, itself if nowhere; paths get shorter
  GatheredLists<TriangleId> triangles_;  ///< boundary triangles of the finest mesh, by corner
};

}  // namespace selvage
