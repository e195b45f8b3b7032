// SPDX-License-Identifier: MIT
//
// Coarser versions of a mesh, all from one sequence of half-edge collapses (dissertation chapter 3; [Hoppe
// 1996]). Each collapse takes a vertex to one of its neighbours, so every level's vertices are vertices of
// the finest mesh: on integer grid coordinates they stay on the grid, and nothing is stored twice.
//
// The order of collapses is by one queue of vertices. The default cost is memoryless with a gate: a vertex
// enters by the mean squared distance of its best target from the planes around it; when it comes to the
// head, the distance from all vertices that were removed here to the new triangles is measured, and if that
// is more, it goes back by that. At a tenth of the triangles this halves the Hausdorff distance of quadrics
// with the same half-edge collapses.
//
// With region labels, a vertex moves only inside its region, and on a region's border only along it, towards
// the same neighbour. The surface for any choice of a level for each region is then the finest mesh with each
// corner replaced by its representative at its region's level, triangles that repeat a vertex dropped: an
// oriented manifold with the same border, whatever the choice. bridge_links.h says why, and boundary_flips.h
// why its joins do not fold over.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

enum class CollapseCost {
  PlaneDistance,  ///< memoryless plane distance and deviation gate; the default
  EdgeArea,       ///< the dissertation's EA, eq. 3.6; for comparison
  Quadric,        ///< quadrics by area [Garland and Heckbert 1997]; for comparison
};

enum class FlipTest {
  Normal,   ///< no triangle turns by 78 degrees or more
  Concave,  ///< the dissertation's: the ring is convex beside the target, Def. 3.2
};

struct SimplifyOptions {
  CollapseCost cost = CollapseCost::PlaneDistance;
  std::optional<FlipTest> flip;  ///< unset: Concave for EdgeArea, as printed; Normal for the others
  /// EdgeArea and Quadric do not need deviations to choose; without, levels have none and cannot be asked for
  /// by error, and simplifying takes half the time.
  bool measures_deviation = true;
};

/// A level ends when either is met: so many triangles are left (or one less), or no legal collapse keeps the
/// deviation.
struct LevelTarget {
  std::uint32_t triangles = 0;
  double max_deviation = std::numeric_limits<double>::infinity();  ///< in units of the positions
};

struct SimplifyInput {
  const CornerTable& mesh;          ///< passes check_corner_table
  std::span<const Vec3> positions;  ///< by vertex, finite; the costs do not depend on the unit
  /// Empty, or a region for every vertex that passes check_partition. kLooseRegion's vertices never move.
  std::span<const RegionId> region_of_vertex = {};
  std::span<const VertexId> pinned =
      {};  ///< vertices that never move, for instance copies that are welded again
};

struct Collapse {
  VertexId from, to;
  double deviation;  ///< that it left around it, see removed_points.h; in units of the positions
};

struct SimplifiedLevel {
  std::uint32_t collapses = 0;  ///< so many of the sequence
  std::uint32_t triangles = 0;  ///< that are left
  double deviation = 0;  ///< the largest so far; the true Hausdorff distance is up to 1.6 times as large
};

struct Simplification {
  std::vector<Collapse> collapses;      ///< in order; a vertex is `from` once at most, and nothing afterwards
  std::vector<SimplifiedLevel> levels;  ///< [0] is the input, then one a target
};

/// Called now and then with how much is done, from 0 to 1. False: it is to stop; what comes back is then
/// worth nothing.
using SimplifyProgress = std::function<bool(double done)>;

/// Runs through the targets, coarsest last; one that is met already repeats the level before. Deterministic.
/// Takes O(n log n) for n triangles, memory of about 50 bytes a triangle beyond the input.
Simplification simplify(const SimplifyInput& input, std::span<const LevelTarget> targets,
                        const SimplifyOptions& options = {}, const SimplifyProgress& progress = {});

/// By vertex: where the first `count` collapses have taken it. Idempotent.
std::vector<VertexId> representatives_after(std::span<const Collapse> collapses, std::uint32_t count,
                                            std::uint32_t vertex_count);

}  // namespace selvage
