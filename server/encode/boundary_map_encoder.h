// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/codec/region_mesh.h"
#include "common/coding/entropy_encoder.h"

namespace selvage {

/// Which vertex of a coarser level stands for each boundary index of the finest one (docs/FORMAT.md,
/// "Boundary map"). `mesh` has its loops and vertex_of_boundary. Along every loop of the finest level, the
/// vertices that stand for it must be a loop of this one, in the same order, each for a run of at least one.
/// Mirror: client/decode/boundary_map_decoder.h.
void encode_boundary_map(const RegionMesh& mesh, std::span<const std::uint32_t> finest_loop_lengths,
                         EntropyEncoder& out);

}  // namespace selvage
