// SPDX-License-Identifier: MIT
//
// Walking around a vertex. All orders are counter-clockwise; an open fan starts at its most clockwise corner.
// A `visit` that returns bool ends the walk with false; one that returns nothing sees everything.
#pragma once

#include <type_traits>

#include "common/mesh/corner_table.h"

namespace selvage {

/// Calls visit and tells whether to go on.
template <class Visit>
bool visit_and_go_on(Visit&& visit, std::uint32_t element) {
  if constexpr (std::is_same_v<decltype(visit(element)), bool>) {
    return visit(element);
  } else {
    visit(element);
    return true;
  }
}

/// Calls visit(c) for every corner at `v`.
template <class Visit>
void for_each_corner_at(const CornerTable& mesh, VertexId v, Visit&& visit) {
  const CornerId first = mesh.corner_of_vertex[v];
  CornerId c = first;
  while (c != kNone) {
    if (!visit_and_go_on(visit, c)) return;
    c = mesh.swing_ccw(c);
    if (c == first) break;
  }
}

/// Calls visit(u) for every vertex that shares an edge with `v`, once an edge: a vertex that two edges lead
/// to (cut non-manifold spots, pillows) comes twice.
template <class Visit>
void for_each_neighbour(const CornerTable& mesh, VertexId v, Visit&& visit) {
  const CornerId first = mesh.corner_of_vertex[v];
  CornerId c = first;
  while (c != kNone) {
    if (!visit_and_go_on(visit, mesh.vertex(next(c)))) return;
    const CornerId left = mesh.swing_ccw(c);
    if (left == kNone)
      visit_and_go_on(visit, mesh.vertex(prev(c)));  // an open fan has one edge more than triangles
    if (left == first) break;
    c = left;
  }
}

}  // namespace selvage
