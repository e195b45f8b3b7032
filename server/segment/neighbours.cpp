// SPDX-License-Identifier: MIT
#include "server/segment/neighbours.h"

#include <numeric>

namespace selvage {

Neighbours::Neighbours(const CornerTable& mesh) : begin_of_vertex_(mesh.vertex_count() + std::size_t{1}, 0) {
  // Each corner lists the vertex after it, so that every edge of a fan is listed once; an open fan has one
  // edge more than corners, the one before its last corner in counter-clockwise order.
  const auto for_each_pair = [&](auto&& visit) {
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
      const auto [a, b, c] = mesh.triangle(t);
      visit(a, b), visit(b, c), visit(c, a);
      if (mesh.opposite[3 * t] == kNone) visit(c, b);
      if (mesh.opposite[3 * t + 1] == kNone) visit(a, c);
      if (mesh.opposite[3 * t + 2] == kNone) visit(b, a);
    }
  };
  for_each_pair([&](VertexId v, VertexId) { ++begin_of_vertex_[v]; });
  std::partial_sum(begin_of_vertex_.begin(), begin_of_vertex_.end(), begin_of_vertex_.begin());
  neighbours_.resize(begin_of_vertex_.back());
  // Backwards from each list's end, which leaves its begin behind.
  for_each_pair([&](VertexId v, VertexId u) { neighbours_[--begin_of_vertex_[v]] = u; });
}

}  // namespace selvage
