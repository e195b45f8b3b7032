// SPDX-License-Identifier: MIT
//
// A corner table that shrinks by half-edge collapses [Hoppe 1996; dissertation section 3.2.2, "subset
// placement"]: u goes to v, the one or two triangles at the edge uv go, and all others keep their number and
// the order of their corners. So a triangle of any resolution is a triangle of the finest one with corners
// replaced.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/corner_table.h"
#include "server/simplify/star.h"

namespace selvage {

class CollapseMesh {
 public:
  explicit CollapseMesh(const CornerTable& mesh) : table_(mesh), triangle_count_(mesh.triangle_count()) {}

  /// Corners of removed triangles are kNone, and so is the corner of a vertex that has none left.
  const CornerTable& table() const { return table_; }
  std::uint32_t triangle_count() const { return triangle_count_; }  ///< that are left

  /// Collapses the star's centre to its ring vertex at `place`. Needs a legal collapse (legality.h) and a
  /// star gathered from this very state. Time: the triangles around both vertices.
  void collapse(const Star& star, std::uint32_t place);

 private:
  void remove_triangle(CornerId outer, CornerId inner);
  void keep_corner(VertexId v, CornerId c);
  bool is_removed(CornerId c) const { return table_.vertex_of_corner[c] == kNone; }

  CornerTable table_;
  std::uint32_t triangle_count_;
};

/// The triangles that are left, vertices without any dropped and the rest renumbered in their order.
CornerTable without_removed(const CornerTable& mesh);

}  // namespace selvage
