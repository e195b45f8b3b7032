// SPDX-License-Identifier: MIT
//
// On a fine mesh the height field is measured at some vertices and spread to the rest: its radius covers
// many edges, so neighbours would say nearly the same. About 8,000 samples suffice at any resolution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

/// Chooses vertices such that every vertex not on the border is within `spacing_of_vertex[s] - 1` edges of a
/// chosen s. Spacing is in edges, >= 1; a vertex of spacing 1 is always chosen. Ascending; depends on the
/// vertex order.
std::vector<VertexId> choose_samples(const CornerTable& mesh,
                                     std::span<const std::uint8_t> spacing_of_vertex);

/// Fills in the values between `samples`: first each vertex takes the nearest sample's (breadth first), then
/// `sweeps` times the mean of its neighbours and itself, in place in that same order; samples keep theirs.
void spread_from_samples(const CornerTable& mesh, std::span<const VertexId> samples, int sweeps,
                         std::span<float> value_of_vertex);

}  // namespace selvage
