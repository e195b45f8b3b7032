// SPDX-License-Identifier: MIT
//
// What decoders refuse (docs/FORMAT.md, "Limits") is refused before anyone is served it.
#pragma once

#include <cstdint>
#include <span>

#include "common/base/result.h"
#include "common/codec/fan_table.h"
#include "common/coding/byte_io.h"
#include "common/mesh/corner_table.h"
#include "common/pack/directory.h"
#include "server/segment/partition.h"

namespace selvage {

/// LimitExceeded if a region might take more than `most_symbols` symbols of connectivity: one for each
/// triangle and for each that closes an inner boundary loop, which are at most as many as it has open edges.
Result<void> check_region_sizes(const CornerTable& table, const Partition& partition,
                                std::uint32_t most_symbols = FanTable::kMostTriangles);

/// LimitExceeded if a part is too large for the directory, or so small that a decoder would not believe that
/// it holds what the directory says of it: very many loose vertices in one place take no bytes.
Result<void> check_parts(std::span<const RegionEntry> regions, std::span<const Bytes> parts);

}  // namespace selvage
