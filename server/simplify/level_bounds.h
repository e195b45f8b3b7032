// SPDX-License-Identifier: MIT
//
// How far a model is from its finest self when each region is at a level of its own, as a number a region and
// level: however they are mixed, no point of either surface is farther from the other than the largest of the
// chosen numbers. Bounded by covering (surface_cover.h), not sampled.
//
// Why that can be said region by region. A mix consists of
//   the insides of regions, each of which depends on its own level alone;
//   strips of triangles between two regions, which depend on the levels of these two;
//   triangles between three regions, which collapses never touch.
// Inside triangles of the finest region are covered by those of the level, but for pieces beyond its
// straightened loops. These strays are covered by the strip that they lie on, or the other region, at every
// level that it may have; and so are the finest triangles of every strip. Whatever two levels cost together
// is charged to the coarser one. The other way round, insides and strips of a mix are covered by the finest
// mesh. What is left is rounding, half a cell's diagonal, which a level's deviation never is less than.
#pragma once

#include <span>

#include "common/base/parallel.h"
#include "server/simplify/level_source.h"
#include "server/simplify/levels.h"
#include "server/simplify/simplify.h"
#include "server/simplify/strips.h"

namespace selvage {

/// Fills in `bound` of all levels, in grid steps: at most a tenth above what is needed, or the deviation that
/// the collapses measured. Needs precisions. The result does not depend on `parallel`; it is worth nothing if
/// `progress` said stop. That is called from several threads at a time if `parallel` uses them, and says stop
/// again once it has said so.
void bound_levels(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels,
                  const ParallelFor& parallel, const SimplifyProgress& progress);

}  // namespace selvage
