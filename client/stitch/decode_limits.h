// SPDX-License-Identifier: MIT
#pragma once

#include "client/decode/region_decoder.h"
#include "common/pack/directory.h"

namespace selvage {

/// What the directory, which is borrowed, promises about a level of a region. The level must exist.
inline DecodeLimits decode_limits(const Directory& directory, RegionId region, std::uint8_t level) {
  const RegionEntry& entry = directory.regions[region];
  const LevelEntry& at = entry.levels[level];
  DecodeLimits limits{at.vertices, at.triangles, entry.box_min, entry.box_max};
  if (level > 0) {
    limits.coarse = CoarseLevel{entry.loop_lengths, at.dropped_bits};
  } else if (directory.is_exact) {
    limits.exact = directory.grid;
  }
  return limits;
}

}  // namespace selvage
