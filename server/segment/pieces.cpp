// SPDX-License-Identifier: MIT
#include "server/segment/pieces.h"

#include <algorithm>

namespace selvage {
namespace {

/// Union-find over interior triangles; the root of a set is its lowest triangle.
class TriangleSets {
 public:
  explicit TriangleSets(std::vector<TriangleId>& parent) : parent_(parent) {}

  TriangleId root(TriangleId t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(TriangleId a, TriangleId b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<TriangleId>& parent_;
};

}  // namespace

Pieces find_pieces(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                   std::uint32_t no_label) {
  Pieces pieces{std::vector<std::uint32_t>(mesh.triangle_count(), kNone), {}, {}};
  std::vector<std::uint32_t>& of_triangle = pieces.of_triangle;  // at first the parent in its set
  TriangleSets sets(of_triangle);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (!is_interior(mesh, label_of_vertex, t, no_label)) continue;
    of_triangle[t] = t;
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      if (mesh.opposite[c] >= 3 * t) continue;  // none, or it will look back at this one
      // The two triangles share an edge, so if both are interior they have one label.
      const TriangleId across = triangle_of(mesh.opposite[c]);
      if (of_triangle[across] != kNone) sets.join(t, across);
    }
  }
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    std::uint32_t& piece = of_triangle[t];
    if (piece == kNone) continue;
    if (piece == t) {
      piece = pieces.count();
      pieces.label.push_back(label_of_vertex[mesh.vertex(3 * t)]);
      pieces.triangle_count.push_back(0);
    } else {
      piece = of_triangle[piece];  // a parent comes before its children: it holds its piece by now
    }
    ++pieces.triangle_count[piece];
  }
  return pieces;
}

}  // namespace selvage
