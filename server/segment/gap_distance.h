// SPDX-License-Identifier: MIT
//
// How far each vertex is from the plateau, in radii. Two basins that join through a gap in the plateau
// narrower than twice `reach` come apart when only what is farther than `reach` counts as basin.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/vec3.h"
#include "server/segment/neighbours.h"

namespace selvage {

/// By vertex: the shortest way along edges to a plateau vertex, each edge's length divided by the mean
/// `radius` of its ends (both in model units); `reach` where it is farther. Dijkstra's algorithm in buckets.
std::vector<float> distance_to_plateau(const Neighbours& neighbours, std::span<const Vec3> positions,
                                       std::span<const std::uint8_t> is_plateau,
                                       std::span<const float> radius, float reach);

}  // namespace selvage
