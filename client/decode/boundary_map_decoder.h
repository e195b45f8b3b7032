// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/base/result.h"
#include "common/codec/region_mesh.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {

/// Gives `mesh`, a coarser level whose loops are known, its vertex_of_boundary (docs/FORMAT.md, "Boundary
/// map"). Safe on hostile input: takes memory for as many indices as the finest level's loops have, which the
/// caller has bounded. Mirror: server/encode/boundary_map_encoder.h.
Result<void> decode_boundary_map(EntropyDecoder& in, std::span<const std::uint32_t> finest_loop_lengths,
                                 RegionMesh& mesh);

}  // namespace selvage
