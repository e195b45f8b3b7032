// SPDX-License-Identifier: MIT
//
// All levels of a partitioned model on its grid: simplified, split by region, each with a precision of its
// own and a bound on its error.
#pragma once

#include <cstdint>
#include <span>

#include "common/base/parallel.h"
#include "server/simplify/levels.h"

namespace selvage {

/// Borrowed for the call.
struct LevelSource {
  const CornerTable& mesh;               ///< passes check_corner_table
  std::span<const GridPoint> positions;  ///< by vertex
  std::span<const RegionId> region_of_vertex;
  std::uint32_t region_count = 0;
  std::span<const VertexId> pinned = {};  ///< copies that are welded again
};

/// One level a target beside the finest. Deterministic, whatever `parallel` is.
///
/// **Precision.** A level gives up as many low bits of its coordinates as make no more of an error than the
/// collapses made, region by region. Rounding turns no triangle over: where it would, the regions that the
/// triangle touches keep more bits, up to all of them.
///
/// **Bound.** Of every region and level: how far, in grid steps, the finest triangles that touch the region
/// are from the model with every region at this level, rounded, and the other way round. Bounded by covering
/// (surface_cover.h), not sampled; at most a tenth above the true distance, or the deviation that the
/// collapses measured. Where neighbours are at other levels it is not a bound but was one in practice
/// (docs/DECISIONS.md).
LevelledMesh make_model_levels(const LevelSource& source, std::span<const LevelTarget> targets,
                               const ParallelFor& parallel, const SimplifyProgress& progress = {});

}  // namespace selvage
