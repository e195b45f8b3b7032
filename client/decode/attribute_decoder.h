// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"

namespace selvage {

/// The mirror of server/encode/attribute_encoder.h. Fills positions, turned bits and anchors of `mesh`, whose
/// table and loops are there already; a loose region's are made here, with `loose_vertices` vertices.
Result<void> decode_attributes(std::span<const std::byte> bytes, const RegionPartHeader& header,
                               std::uint32_t loose_vertices, RegionMesh& mesh);

}  // namespace selvage
