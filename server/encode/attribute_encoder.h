// SPDX-License-Identifier: MIT
#pragma once

#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"
#include "common/coding/entropy_encoder.h"

namespace selvage {

/// Positions, turned bits and anchors of a region whose connectivity the decoder already has (docs/FORMAT.md,
/// "Region part"). `box` holds all positions. Mirror: client/decode/attribute_decoder.h.
void encode_attributes(const RegionMesh& mesh, const GridBox& box, const CodecTables& tables,
                       EntropyEncoder& out);

}  // namespace selvage
