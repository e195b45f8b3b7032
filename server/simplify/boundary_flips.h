// SPDX-License-Identifier: MIT
//
// The test by normals for collapses along region borders, against levels of the neighbour other than the
// current one.
//
// Why: where two regions' loops turn together, on a crease or around a corner, both may be straightened
// without a trace. Against a neighbour that has stayed fine the straight loop cuts across the bends, and
// boundary triangles fold over. bridge_links.h says why the levels published so far are all that matter; its
// argument makes this as strong as the test on the mesh in hand.
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
  BoundaryFlips(const CornerTable& mesh, std::span<const Vec3> positions,
                std::span<const RegionId> region_of_vertex);

  /// Whether no boundary triangle turns by 78 degrees or more when u, all of whose neighbours in other
  /// regions are in one region, goes to v: with that region at its finest level and at each of `published`,
  /// which are representatives by vertex.
  bool keep_normals(VertexId u, VertexId v, std::span<const std::vector<VertexId>> published);

  void collapse(VertexId u, VertexId v);

 private:
  VertexId current(VertexId v);
  bool keeps_normal(TriangleId t, VertexId u, VertexId v, std::span<const VertexId> representative_of_vertex);

  const CornerTable& mesh_;
  std::span<const Vec3> positions_;
  std::span<const RegionId> region_of_vertex_;
  std::vector<VertexId> next_on_way_;    ///< by vertex: where it went, itself if nowhere; paths get shorter
  GatheredLists<TriangleId> triangles_;  ///< boundary triangles of the finest mesh, by corner
};

}  // namespace selvage
