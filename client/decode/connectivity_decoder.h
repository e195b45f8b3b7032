// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/base/result.h"
#include "common/codec/fan_table.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {

/// The mirror of server/encode/connectivity_encoder.h. Time and memory are linear in `triangles`, which the
/// caller bounds: the region's own triangles, fans around virtual vertices not counted. What `table` held is
/// lost.
Result<void> decode_connectivity(EntropyDecoder& in, std::uint32_t triangles, FanTable& table);

}  // namespace selvage
