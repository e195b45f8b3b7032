// SPDX-License-Identifier: MIT
//
// `selvage-client draw --levels`: the model at each of its levels, a view with every region at a level of its
// own, and a close look at a seam between fine and coarse.
#pragma once

#include <functional>
#include <vector>

#include "client/stitch/stitcher.h"
#include "common/pack/selection.h"
#include "common/render/sheet.h"

namespace selvage {

/// The stitched mesh of a selection of one model.
using LoadMesh = std::function<Result<StitchedMesh>(const Selection&)>;

/// Pictures of `size` pixels' width. With a single level there is nothing to mix: the model alone.
Result<std::vector<Panel>> draw_levels(const Directory& directory, const LoadMesh& load, UpAxis up, int size);

}  // namespace selvage
