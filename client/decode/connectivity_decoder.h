// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/base/result.h"
#include "common/coding/entropy_decoder.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// The mirror of server/encode/connectivity_encoder.h. Time and memory are linear in `triangles`, which the
/// caller bounds: the region's own triangles, fans around virtual vertices not counted.
Result<CornerTable> decode_connectivity(EntropyDecoder& in, std::uint32_t triangles);

}  // namespace selvage
