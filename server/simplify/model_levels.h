// SPDX-License-Identifier: MIT
//
// All levels of a partitioned model on its grid: simplified, split by region, each with a precision of its
// own and a bound on its error.
#pragma once

#include <span>

#include "common/base/parallel.h"
#include "server/simplify/level_source.h"
#include "server/simplify/levels.h"

namespace selvage {

/// One level a target beside the finest. Deterministic, whatever `parallel` is. If `progress` says stop, what
/// comes back is worth nothing; it is called from several threads at a time if `parallel` uses them, and says
/// stop again once it has said so.
///
/// A level gives up as many low bits of its coordinates as make no more of an error than the collapses made
/// (level_precision.h). Bounds hold in every mix of levels (level_bounds.h).
LevelledMesh make_model_levels(const LevelSource& source, std::span<const LevelTarget> targets,
                               const ParallelFor& parallel, const SimplifyProgress& progress = {});

}  // namespace selvage
