// SPDX-License-Identifier: MIT
//
// Any file's triangles at any resolution, in the file's own vertices.
#pragma once

#include "common/base/result.h"
#include "common/mesh/triangle_soup.h"
#include "server/ingest/repair.h"
#include "server/simplify/simplify.h"

namespace selvage {

struct SimplifiedSoup {
  TriangleSoup soup;
  RepairReport repair;            ///< of the input
  std::uint32_t input_triangles;  ///< after repair
  std::uint32_t pinned_vertices;  ///< of the repaired mesh
  double deviation = 0;           ///< in units of the positions, see SimplifiedLevel
};

/// Repairs the soup (repair.h), simplifies it, and undoes the repair as far as it still has a meaning: copies
/// of a split vertex become one vertex again, turned triangles turn back. What is left of the file's vertices
/// and triangles keeps its order and exact coordinates; dropped are unreferenced vertices and triangles that
/// repeat an index.
///
/// The copies of a split vertex are pinned, so non-manifold spots stay as they are, and a model that is
/// little else does not shrink. Where a triangle comes to lie between two copies of one vertex, welding makes
/// it a line; it is dropped, and the triangles beside it meet. Fans that were apart at a split vertex may
/// come to share an edge there: where the file is not manifold, the result need not be either, but no border
/// opens.
///
/// A model whose components are all as simple as they can be (a tetrahedron, a triangle) stays above the
/// target. Fails as repair does; Cancelled if `progress` says stop.
Result<SimplifiedSoup> simplify_soup(const TriangleSoup& soup, const LevelTarget& target,
                                     const SimplifyOptions& options = {},
                                     const SimplifyProgress& progress = {});

}  // namespace selvage
