// SPDX-License-Identifier: MIT
#include "server/simplify/collapse_mesh.h"

namespace selvage {

/// Takes out the triangle of both corners and glues what lies across them:
///
///             w                `outer` is at u and faces the edge v-w, `inner` is at v and faces u-w.
///           / | .              Afterwards the triangles beyond the two edges are neighbours.
///     inner   |   outer
///       v --- u
void CollapseMesh::remove_triangle(CornerId outer, CornerId inner) {
  const CornerId beyond_outer = table_.opposite[outer], beyond_inner = table_.opposite[inner];
  if (beyond_outer != kNone) table_.opposite[beyond_outer] = beyond_inner;
  if (beyond_inner != kNone) table_.opposite[beyond_inner] = beyond_outer;
  const CornerId first = 3 * triangle_of(outer);
  for (CornerId c = first; c < first + 3; ++c) table_.vertex_of_corner[c] = table_.opposite[c] = kNone;
  --triangle_count_;
}

/// Keeps for v the most clockwise corner of the fan that c is in.
void CollapseMesh::keep_corner(VertexId v, CornerId c) {
  CornerId at = c;
  for (CornerId further = table_.swing_cw(at); further != kNone && further != c;
       further = table_.swing_cw(at)) {
    at = further;
  }
  table_.corner_of_vertex[v] = at;
}

void CollapseMesh::collapse(const Star& star, std::uint32_t place) {
  const VertexId v = star.ring[place];
  const std::uint32_t after = star.triangle_after(place), before = star.triangle_before(place);
  CornerId kept = kNone;
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    table_.vertex_of_corner[star.corners[i]] = v;
    if (i != after && i != before) kept = star.corners[i];
  }
  // A corner that the third vertices keep if theirs goes: in the triangle beyond the edge to the centre, or
  // beyond the other edge where that one is the border.
  CornerId spare_after = kNone, spare_before = kNone;
  if (after != kNone) {
    const CornerId c = star.corners[after], inner = table_.opposite[next(c)], outer = table_.opposite[c];
    spare_after = inner != kNone ? prev(inner) : next(outer);
    remove_triangle(c, next(c));
  }
  if (before != kNone) {
    const CornerId c = star.corners[before], inner = table_.opposite[prev(c)], outer = table_.opposite[c];
    spare_before = inner != kNone ? next(inner) : prev(outer);
    remove_triangle(c, prev(c));
  }
  table_.corner_of_vertex[star.centre] = kNone;
  keep_corner(v, kept);
  const auto repair_corner = [&](std::uint32_t third, CornerId spare) {
    const VertexId w = star.ring[third];
    if (is_removed(table_.corner_of_vertex[w])) keep_corner(w, spare);
  };
  if (after != kNone) repair_corner(star.next_place(place), spare_after);
  if (before != kNone) repair_corner(star.previous_place(place), spare_before);
}

CornerTable without_removed(const CornerTable& mesh) {
  std::vector<CornerId> new_corner(mesh.corner_count(), kNone);
  std::vector<VertexId> new_vertex(mesh.vertex_count(), kNone);
  CornerTable dense;
  for (VertexId v = 0, count = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corner_of_vertex[v] != kNone) new_vertex[v] = count++;
  }
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    if (mesh.vertex(c) == kNone) continue;
    new_corner[c] = dense.corner_count();
    dense.vertex_of_corner.push_back(new_vertex[mesh.vertex(c)]);
  }
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    if (mesh.vertex(c) == kNone) continue;
    dense.opposite.push_back(mesh.opposite[c] == kNone ? kNone : new_corner[mesh.opposite[c]]);
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (new_vertex[v] != kNone) dense.corner_of_vertex.push_back(new_corner[mesh.corner_of_vertex[v]]);
  }
  return dense;
}

}  // namespace selvage
