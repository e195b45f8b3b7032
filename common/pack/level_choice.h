// SPDX-License-Identifier: MIT
//
// Which level of each region to ask for: by the error that may remain, or by the bytes that may be spent.
// From the directory alone, so servers never choose.
#pragma once

#include "common/base/result.h"
#include "common/pack/directory.h"
#include "common/pack/selection.h"

namespace selvage {

/// How far a region at a level may be from the model that was packed, in model units: the level's deviation
/// and the rounding of the grid that it is measured on. 0 at the finest level of a bit-exact model.
double level_error(const Directory& directory, RegionId region, std::uint32_t level);

/// The selection with every selected region at its coarsest level of at most that error; regions that have a
/// level of their own in it keep that. InvalidArgument if the grid's rounding alone is more.
Result<Selection> choose_by_error(const Directory& directory, Selection selection, double max_error);

/// The selection with levels such that its parts take at most so many bytes, the sum of the regions' errors
/// as small as going finer where the error falls most a byte makes it: more than the least possible sum by at
/// most what one region's step to a finer level would take off. Regions that have a level of their own keep
/// that. LimitExceeded says how many bytes the coarsest levels take, if that is more.
Result<Selection> choose_by_budget(const Directory& directory, Selection selection, std::uint64_t max_bytes);

}  // namespace selvage
