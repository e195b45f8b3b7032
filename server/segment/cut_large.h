// SPDX-License-Identifier: MIT
//
// Cuts regions that are too large to stream as one. No shape tells where: pieces only should be compact and
// alike.
#pragma once

#include <cstdint>

#include "server/segment/minima.h"
#include "server/segment/neighbours.h"

namespace selvage {

/// Cuts every label of n > max_vertices vertices into ceil(n / (0.9 max_vertices)) pieces: each next seed is
/// the vertex farthest, in edges, from all seeds so far, and vertices go to the nearest seed. New labels are
/// added after the old ones. Pieces come out near the mean size, not exactly. O(V log pieces).
void cut_large_regions(const Neighbours& neighbours, Minima& labels, std::uint32_t max_vertices);

}  // namespace selvage
