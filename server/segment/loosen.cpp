// SPDX-License-Identifier: MIT
#include "server/segment/loosen.h"

#include <vector>

#include "server/segment/one_ring.h"
#include "server/segment/pieces.h"

namespace selvage {
namespace {

/// How the interior triangles lie around each vertex, kept up to date while triangles are taken away. A fan
/// starts at an interior corner that has no interior corner clockwise of it; a closed fan that is all
/// interior has no start. So a vertex fits if it has interior corners and at most one start. Vertices are
/// counted when they first matter: far from any border all of them fit.
class FanCount {
 public:
  FanCount(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex)
      : mesh_(mesh), is_interior_(mesh.triangle_count()), fans_(mesh.vertex_count()) {
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t)
      is_interior_[t] = is_interior(mesh, label_of_vertex, t, kNone);
  }

  bool fits(VertexId v) {
    const Fans& fans = counted(v);
    return fans.corners > 0 && fans.starts <= 1;
  }
  bool has(CornerId c) const { return c != kNone && is_interior_[triangle_of(c)]; }

  void remove(TriangleId t) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      Fans& fans = counted(mesh_.vertex(c));
      --fans.corners;
      if (!has(mesh_.swing_cw(c))) --fans.starts;  // c was a start
      if (has(mesh_.swing_ccw(c))) ++fans.starts;  // the next one becomes a start
    }
    is_interior_[t] = 0;
  }

 private:
  struct Fans {
    std::uint32_t corners = kNone, starts = 0;  // of interior triangles; kNone: not counted yet
  };

  Fans& counted(VertexId v) {
    Fans& fans = fans_[v];
    if (fans.corners != kNone) return fans;
    fans.corners = 0;
    for_each_corner_at(mesh_, v, [&](CornerId c) {
      if (!has(c)) return;
      ++fans.corners;
      fans.starts += !has(mesh_.swing_cw(c));
    });
    return fans;
  }

  const CornerTable& mesh_;
  std::vector<std::uint8_t> is_interior_;
  std::vector<Fans> fans_;  // by vertex
};

}  // namespace

std::uint32_t loosen_misfits(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex) {
  FanCount fans(mesh, label_of_vertex);
  std::vector<VertexId> misfits;
  const auto check = [&](VertexId v) {
    if (label_of_vertex[v] == kNone || fans.fits(v)) return;
    label_of_vertex[v] = kNone;
    misfits.push_back(v);
  };
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (fans.has(3 * t)) continue;
    for (VertexId v : mesh.triangle(t)) check(v);
  }
  std::uint32_t alone = 0;  // vertices without triangles
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corner_of_vertex[v] == kNone && label_of_vertex[v] != kNone) label_of_vertex[v] = kNone, ++alone;
  }
  for (std::size_t at = 0; at < misfits.size(); ++at) {
    for_each_corner_at(mesh, misfits[at], [&](CornerId c) {
      if (!fans.has(c)) return;
      fans.remove(triangle_of(c));
      check(mesh.vertex(next(c)));
      check(mesh.vertex(prev(c)));
    });
  }
  return alone + static_cast<std::uint32_t>(misfits.size());
}

}  // namespace selvage
