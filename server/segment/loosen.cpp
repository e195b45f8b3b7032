// SPDX-License-Identifier: MIT
#include "server/segment/loosen.h"

#include <vector>

#include "server/segment/one_ring.h"
#include "server/segment/pieces.h"

namespace selvage {
namespace {

/// How the interior triangles lie around each vertex, kept up to date while triangles are taken away.
/// A fan starts at an interior corner that has no interior corner clockwise of it; a closed fan that is all
/// interior has no start. So a vertex fits if it has interior corners and at most one start.
class FanCount {
 public:
  FanCount(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex)
      : mesh_(mesh),
        is_interior_(mesh.triangle_count()),
        corners_(mesh.vertex_count(), 0),
        starts_(corners_) {
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t)
      is_interior_[t] = is_interior(mesh, label_of_vertex, t, kNone);
    for (CornerId c = 0; c < mesh.corner_count(); ++c) {
      if (!has(c)) continue;
      ++corners_[mesh.vertex(c)];
      starts_[mesh.vertex(c)] += !has(mesh.swing_cw(c));
    }
  }

  bool fits(VertexId v) const { return corners_[v] > 0 && starts_[v] <= 1; }
  bool has(CornerId c) const { return c != kNone && is_interior_[triangle_of(c)]; }

  void remove(TriangleId t) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      const VertexId v = mesh_.vertex(c);
      --corners_[v];
      if (!has(mesh_.swing_cw(c))) --starts_[v];  // c was a start
      if (has(mesh_.swing_ccw(c))) ++starts_[v];  // the next one becomes a start
    }
    is_interior_[t] = 0;
  }

 private:
  const CornerTable& mesh_;
  std::vector<std::uint8_t> is_interior_;
  std::vector<std::uint32_t> corners_, starts_;  // by vertex, of interior triangles
};

}  // namespace

void loosen_misfits(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex) {
  FanCount fans(mesh, label_of_vertex);
  std::vector<VertexId> misfits;
  const auto check = [&](VertexId v) {
    if (label_of_vertex[v] == kNone || fans.fits(v)) return;
    label_of_vertex[v] = kNone;
    misfits.push_back(v);
  };
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) check(v);
  for (std::size_t at = 0; at < misfits.size(); ++at) {
    for_each_corner_at(mesh, misfits[at], [&](CornerId c) {
      if (!fans.has(c)) return;
      fans.remove(triangle_of(c));
      check(mesh.vertex(next(c)));
      check(mesh.vertex(prev(c)));
    });
  }
}

}  // namespace selvage
