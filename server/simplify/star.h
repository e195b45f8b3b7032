// SPDX-License-Identifier: MIT
//
// A vertex with the triangles around it, gathered once for everything that is asked about collapsing it.
//
//        r[1] ---- r[0]            Triangle i is (centre, ring[i], ring[i + 1]), counter-clockwise, and
//        /  \ t[0] /  \            corners[i] is its corner at the centre. A closed star has as many ring
//       /    \    /    \           vertices as triangles, an open one (at the border) one more.
//     r[2] -- centre -- r[5]
//
// A "place" is an index into the ring: the neighbour that the centre may be collapsed to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

struct Star {
  VertexId centre = kNone;
  bool is_closed = false;
  Vec3 centre_point;
  std::vector<CornerId> corners;
  std::vector<VertexId> ring;
  std::vector<Vec3> points;          ///< of the ring
  std::vector<Vec3> normals;         ///< of the triangles; their length is twice the area
  std::vector<double> double_areas;  ///< lengths of `normals`
  double sum_of_double_areas = 0;

  std::uint32_t size() const { return static_cast<std::uint32_t>(corners.size()); }
  std::uint32_t ring_size() const { return static_cast<std::uint32_t>(ring.size()); }
  std::uint32_t next_place(std::uint32_t place) const { return place + 1 == ring_size() ? 0 : place + 1; }
  std::uint32_t previous_place(std::uint32_t place) const { return place == 0 ? ring_size() - 1 : place - 1; }

  /// The two triangles at the edge from the centre to a ring vertex, as indices; kNone past a border.
  std::uint32_t triangle_after(std::uint32_t place) const { return place < size() ? place : kNone; }
  std::uint32_t triangle_before(std::uint32_t place) const {
    return place > 0 ? place - 1 : is_closed ? size() - 1 : kNone;
  }
  bool is_at_edge(std::uint32_t triangle, std::uint32_t place) const {
    return triangle == triangle_after(place) || triangle == triangle_before(place);
  }
  /// Triangles that go when the centre is collapsed to the ring vertex.
  std::uint32_t triangles_at_edge(std::uint32_t place) const {
    return (triangle_after(place) != kNone) + (triangle_before(place) != kNone);
  }
  const Vec3& second_point(std::uint32_t triangle) const { return points[next_place(triangle)]; }

  /// Place of `v` in the ring, kNone if it is not there.
  std::uint32_t place_of(VertexId v) const;

  /// Gathers the star of `v`, which has at least one triangle. Keeps the vectors' memory.
  void gather(const CornerTable& mesh, std::span<const Vec3> positions, VertexId v);
};

}  // namespace selvage
