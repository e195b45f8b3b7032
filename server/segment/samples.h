// SPDX-License-Identifier: MIT
//
// On a fine mesh the height field is measured at some vertices and spread to the rest: its radius covers
// many edges, so neighbours would say nearly the same. About 8,000 samples suffice at any resolution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "server/segment/neighbours.h"

namespace selvage {

struct Samples {
  std::vector<VertexId> vertices;           ///< ascending
  std::vector<VertexId> nearest_of_vertex;  ///< a near sample; kNone only at the border
};

/// Chooses vertices such that every vertex not on the border is within `spacing_of_vertex[s] - 1` edges of a
/// chosen s. Spacing is in edges, 1 to 255; a vertex of spacing 1 is always chosen. Depends on the vertex
/// order, and runs in parallel only if that keeps neighbours together (server/ingest/spatial_order.h).
Samples choose_samples(const CornerTable& mesh, const Neighbours& neighbours,
                       std::span<const std::uint8_t> spacing_of_vertex, const ParallelFor& parallel);

/// Fills in the values between samples: first each vertex takes its nearest sample's, then `sweeps` times the
/// mean of its neighbours and itself; samples keep theirs.
void spread_from_samples(const Neighbours& neighbours, const Samples& samples, int sweeps,
                         std::vector<float>& value_of_vertex, const ParallelFor& parallel);

}  // namespace selvage
