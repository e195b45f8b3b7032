// SPDX-License-Identifier: MIT
//
// Connectivity of an oriented 2-manifold with boundary, as flat arrays [Rossignac 2001, "3D compression made
// simple"]. Corner c belongs to triangle c/3; its opposite corner lies across the edge that c faces.
//
//            prev(c)                     c's triangle is (c, next(c), prev(c)), counter-clockwise.
//            /  |  \                     opposite(c) faces the same edge from the other side.
//           /   |   \                    A border edge has opposite kNone.
//          c    |    opposite(c)
//           \   |   /
//            \  |  /
//            next(c)
//
// `opposite` is stated, not derived from shared indices: where a non-manifold edge was cut, two triangles may
// share both vertices of an edge and still not be neighbours across it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

inline CornerId next(CornerId c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline CornerId prev(CornerId c) { return c % 3 == 0 ? c + 2 : c - 1; }
inline TriangleId triangle_of(CornerId c) { return c / 3; }

struct CornerTable {
  std::vector<VertexId> vertex_of_corner;  ///< 3 a triangle
  std::vector<CornerId> opposite;          ///< 3 a triangle; kNone at the border
  /// One corner a vertex: at a border vertex the most clockwise one, so that swinging counter-clockwise from
  /// it visits the whole fan. kNone for a vertex without triangles.
  std::vector<CornerId> corner_of_vertex;

  std::uint32_t corner_count() const { return static_cast<std::uint32_t>(vertex_of_corner.size()); }
  std::uint32_t triangle_count() const { return corner_count() / 3; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(corner_of_vertex.size()); }

  VertexId vertex(CornerId c) const { return vertex_of_corner[c]; }

  /// The corner at the same vertex in the next triangle counter-clockwise, kNone past a border.
  CornerId swing_ccw(CornerId c) const {
    const CornerId across = opposite[next(c)];
    return across == kNone ? kNone : next(across);
  }
  /// The same, clockwise.
  CornerId swing_cw(CornerId c) const {
    const CornerId across = opposite[prev(c)];
    return across == kNone ? kNone : prev(across);
  }
  /// True if the vertex's fan is open. Needs at least one triangle at `v`.
  bool is_border_vertex(VertexId v) const { return swing_cw(corner_of_vertex[v]) == kNone; }

  Triangle triangle(TriangleId t) const {
    return {vertex_of_corner[3 * t], vertex_of_corner[3 * t + 1], vertex_of_corner[3 * t + 2]};
  }

  /// Fills `corner_of_vertex` from the other two arrays.
  void set_corner_of_vertex(std::uint32_t vertex_count);
};

/// Builds the table of a mesh whose triangles, by shared indices alone, already are an oriented manifold
/// with boundary (generated shapes, decoded meshes, tests; files go through server/ingest/repair).
/// An edge that this is not true of stays open on all sides, so check_corner_table tells.
CornerTable build_corner_table(std::span<const Triangle> triangles, std::uint32_t vertex_count);

}  // namespace selvage
