// SPDX-License-Identifier: MIT
#pragma once

#include "common/codec/region_mesh.h"
#include "common/coding/byte_io.h"

namespace selvage {

/// Positions, turned bits and anchors of a region whose connectivity the decoder already has: the attribute
/// stream of docs/FORMAT.md. Mirror: client/decode/attribute_decoder.h.
Bytes encode_attributes(const RegionMesh& mesh, int bits);

}  // namespace selvage
