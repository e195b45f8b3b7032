// SPDX-License-Identifier: MIT
//
// Plateau erosion, dissertation section 4.2.3 and Table 4.2: all basins grow over the plateau at the same
// speed, one edge a step, until they meet.
#pragma once

#include <cstdint>

#include "server/segment/minima.h"
#include "server/segment/neighbours.h"

namespace selvage {

/// Gives every vertex a label. The table may push a vertex twice and does not say which label wins; here a
/// vertex is labelled when it is pushed, by its first labelled neighbour in the first step and by whichever
/// front reaches it first after that. A component that is all plateau becomes one region with a new label,
/// counted in `minima.count`. Linear time.
void erode_plateau(const Neighbours& neighbours, Minima& minima);

}  // namespace selvage
