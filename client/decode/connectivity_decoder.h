// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/result.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// The mirror of server/encode/connectivity_encoder.h: `symbols` CLERS symbols from a connectivity stream.
/// Time and memory are linear in `symbols`, which the caller bounds.
Result<CornerTable> decode_connectivity(std::span<const std::byte> bytes, std::uint32_t symbols);

}  // namespace selvage
