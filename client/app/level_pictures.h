// SPDX-License-Identifier: MIT
//
// `selvage-client draw --levels`: the model at each of its levels, a view with every region at a level of its
// own, and a close look at a seam between fine and coarse.
#pragma once

#include <string>
#include <vector>

#include "client/live/live_model.h"
#include "common/render/sheet.h"

namespace selvage {

/// Pictures of `size` pixels' width. Refines one model in place on the way, so every level is fetched once.
/// With a single level there is nothing to mix: the model alone.
Result<std::vector<Panel>> draw_levels(LiveModel& model, UpAxis up, int size);

}  // namespace selvage
