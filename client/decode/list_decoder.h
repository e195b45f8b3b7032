// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/base/result.h"
#include "common/codec/fan_table.h"
#include "common/codec/fan_walk.h"
#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"
#include "common/coding/entropy_decoder.h"
#include "common/mesh/grid.h"

namespace selvage {

/// The mirror of server/encode/list_encoder.h; fills in table, loops and positions of `mesh`, and the floats
/// of a bit-exact model, whose grid is `exact`.
Result<void> decode_listed_positions(EntropyDecoder& in, const GridBox& box, std::uint32_t vertices,
                                     const Grid* exact, const FanTable& table, FanWalk::Memory& memory,
                                     RegionMesh& mesh);

}  // namespace selvage
