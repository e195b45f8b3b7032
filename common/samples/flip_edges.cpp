// SPDX-License-Identifier: MIT
#include "common/samples/flip_edges.h"

#include <cstdint>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {
namespace {

class Flipper {
 public:
  explicit Flipper(TriangleSoup& soup)
      : soup_(soup),
        table_(build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size()))) {}

  void run() {
    for (int pass = 0; pass < 20 && flip_all() > 0; ++pass) {
    }
    for (TriangleId t = 0; t < table_.triangle_count(); ++t) soup_.triangles[t] = table_.triangle(t);
  }

 private:
  std::size_t flip_all() {
    std::size_t flips = 0;
    for (CornerId c = 0; c < table_.corner_count(); ++c) {
      const CornerId o = table_.opposite[c];
      if (o == kNone || o < c || !is_too_blunt(c, o) || !is_allowed(c, o)) continue;
      flip(c, o);
      ++flips;
    }
    return flips;
  }

  const Vec3& position(CornerId c) const { return soup_.positions[table_.vertex(c)]; }

  /// Cotangent of the angle at a corner.
  double cotangent(CornerId c) const {
    const Vec3 a = position(next(c)) - position(c), b = position(prev(c)) - position(c);
    const double sine = length(cross(a, b));
    return dot(a, b) / (sine > 1e-300 ? sine : 1e-300);
  }

  /// Angles beyond 180 degrees in sum have a negative sum of cotangents; the margin keeps ties from flipping
  /// on and on.
  bool is_too_blunt(CornerId c, CornerId o) const { return cotangent(c) + cotangent(o) < -1e-9; }

  bool is_allowed(CornerId c, CornerId o) const {
    const Vec3 &x = position(c), &u = position(next(c)), &v = position(prev(c)), &y = position(o);
    const Vec3 before = normalised(cross(u - x, v - x) + cross(v - y, u - y));
    const Vec3 one = normalised(cross(u - x, y - x)), two = normalised(cross(v - y, x - y));
    return dot(one, before) > 0.9 && dot(two, before) > 0.9 && !has_edge(c, table_.vertex(o));
  }

  /// Whether the vertex of corner `c` has an edge to `to`: looks at its whole fan, both ways from c.
  bool has_edge(CornerId c, VertexId to) const {
    CornerId at = c;
    do {
      if (table_.vertex(next(at)) == to || table_.vertex(prev(at)) == to) return true;
      at = table_.swing_ccw(at);
    } while (at != kNone && at != c);
    if (at == c) return false;
    for (at = table_.swing_cw(c); at != kNone; at = table_.swing_cw(at))
      if (table_.vertex(next(at)) == to || table_.vertex(prev(at)) == to) return true;
    return false;
  }

  //        v                     v
  //      / | \                 /   \                  c, o keep their vertices x, y;
  //   x c  |  o y     ->    x c-----o y               the corner at v in c's triangle moves to y,
  //      \ | /                 \   /                  the corner at u in o's triangle moves to x.
  //        u                     u
  void flip(CornerId c, CornerId o) {
    const CornerId cu = next(c), cv = prev(c), ov = next(o), ou = prev(o);
    const CornerId vx = table_.opposite[cu], xu = table_.opposite[cv];
    const CornerId uy = table_.opposite[ov], yv = table_.opposite[ou];
    table_.vertex_of_corner[cv] = table_.vertex(o);
    table_.vertex_of_corner[ou] = table_.vertex(c);
    link(c, uy);
    link(cu, ov);
    link(cv, xu);
    link(o, vx);
    link(ou, yv);
  }

  void link(CornerId a, CornerId b) {
    table_.opposite[a] = b;
    if (b != kNone) table_.opposite[b] = a;
  }

  TriangleSoup& soup_;
  CornerTable table_;  // corner_of_vertex is stale after a flip; nothing here uses it
};

}  // namespace

void flip_to_delaunay(TriangleSoup& soup) { Flipper(soup).run(); }

}  // namespace selvage
