// SPDX-License-Identifier: MIT
//
// Turns whatever triangles a file holds into an oriented 2-manifold with boundary, and remembers how to turn
// it back: nothing is lost but triangles that name a vertex twice. Works on the file's vertex indices alone;
// positions never decide what is connected (models whose vertices are split on purpose stay so).
//
// - A triangle with a repeated index is dropped; vertices that nothing uses are dropped. Both are reported.
//   Duplicate and zero-area triangles are kept.
// - Two triangles at an edge are neighbours, whichever way the file turns them; pieces connected so are
//   oriented alike (orient.h), and edges are cut only where a piece is not orientable.
// - Three or more triangles at an edge are neighbours two by two, where their directions allow (adjacency.h).
// - A vertex with several fans of triangles is split into one copy a fan (split_fans.h).
//
// The inverse, which the client performs, is to weld the copies of a vertex and to turn the turned triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/result.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// What was found in the file and what was done about it, as counts.
struct RepairReport {
  std::uint32_t dropped_triangles = 0;      ///< with a repeated index: the only ones lost
  std::uint32_t unreferenced_vertices = 0;  ///< dropped; used by no triangle that is kept
  std::uint32_t duplicate_triangles = 0;    ///< kept; same three vertices as an earlier one, in any order
  std::uint32_t zero_area_triangles = 0;    ///< kept
  std::uint32_t non_manifold_edges = 0;     ///< with three or more triangles
  std::uint32_t non_manifold_vertices = 0;  ///< stored more than once: several fans after edges were cut
  std::uint32_t vertex_copies = 0;          ///< vertices added by splitting those
  std::uint32_t turned_triangles = 0;
  std::uint32_t non_orientable_cuts = 0;  ///< edges cut because a piece is not orientable
  std::uint32_t components = 0;           ///< connected pieces of the repaired mesh
  std::uint32_t boundary_edges = 0;       ///< of the repaired mesh, an edge that was cut counting once a side
};

struct RepairedMesh {
  CornerTable table;                           ///< passes check_corner_table; every vertex has one fan
  std::vector<Vec3> positions;                 ///< by vertex
  std::vector<VertexId> source_of_vertex;      ///< the file's vertex; copies of a split vertex share one
  std::vector<TriangleId> source_of_triangle;  ///< the file's triangle; its first corner is still the first
  std::vector<bool> is_turned;  ///< by triangle: its second and third corner are swapped against the file
  RepairReport report;
};

/// Linear time, deterministic. Fails if no triangle is left or if there are more than corner ids can count.
/// Needs what TriangleSoup promises: indices in range.
Result<RepairedMesh> repair(const TriangleSoup& soup);

}  // namespace selvage
