// SPDX-License-Identifier: MIT
#pragma once

#include "client/decode/region_decoder.h"
#include "common/codec/region_format.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {

/// The mirror of server/encode/attribute_encoder.h. Fills positions, turned bits and anchors of `mesh`, whose
/// table and loops are there already; a loose region's are made by decode_loose_vertices.
Result<void> decode_attributes(EntropyDecoder<2>& in, const RegionPartHeader& header,
                               const DecodeLimits& expected, const CodecTables& tables, RegionMesh& mesh);

}  // namespace selvage
