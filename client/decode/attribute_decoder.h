// SPDX-License-Identifier: MIT
#pragma once

#include "common/base/result.h"
#include "common/codec/geometry_walk.h"
#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {

// The mirrors of server/encode/attribute_encoder.h.

/// Numbers the vertices of `table`, which must be `vertices` fans of corners, in coding order; fills the
/// mesh's triangles, positions and loops.
Result<void> decode_positions(EntropyDecoder& in, const GridBox& box, std::uint32_t vertices,
                              const CodecTables& tables, const FanTable& table, GeometryWalk::Memory& memory,
                              RegionMesh& mesh);
/// `count` positions that no triangle connects; each must cost bits, or the caller has bounded it.
Result<void> decode_loose_positions(EntropyDecoder& in, std::uint32_t count, const GridBox& box,
                                    RegionMesh& mesh);
/// Fills turned bits and anchors. Needs the boundary loops; checks that the stream ends here.
Result<void> decode_turned_and_anchors(EntropyDecoder& in, const RegionPartHeader& header, RegionMesh& mesh);

}  // namespace selvage
