// SPDX-License-Identifier: MIT
//
// The region part's layout (docs/FORMAT.md, "Region part"):
//
//   u8      version and flags: low 4 bits kRegionPartVersion, then has_turned, has_anchors, two reserved (0)
//   u8      grid bits of this part's positions
//   varint  symbols: CLERS symbols in the connectivity stream
//   varint  size of the connectivity stream in bytes
//   bytes   connectivity stream: entropy coded, one state
//   bytes   attribute stream: entropy coded, two states, to the end of the part: positions, turned bits,
//   anchors
//
// A part without symbols holds loose vertices: its connectivity stream is empty, and their number comes first
// in the attribute stream.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/result.h"
#include "common/coding/adaptive_model.h"
#include "common/coding/byte_io.h"
#include "common/mesh/boundary_loops.h"

namespace selvage {

inline constexpr std::uint8_t kRegionPartVersion = 1;

struct RegionPartHeader {
  bool has_turned = false;
  bool has_anchors = false;
  int bits = 0;
  std::uint32_t symbols = 0;
  std::uint32_t connectivity_size = 0;
};

void write_region_header(ByteWriter& out, const RegionPartHeader& header);
Result<RegionPartHeader> read_region_header(ByteReader& in);

/// The models of everything in a connectivity stream that is not a CLERS symbol.
struct ConnectivityModels {
  AdaptiveModel<33> counts;
  AdaptiveModel<33> handle_gap, handle_reach;
  AdaptiveModel<33> virtual_gap;
  AdaptiveModel<2> is_closed;
};

/// Turned bits in the context of the triangle before; anchors as gaps in the order "boundary vertices by
/// boundary index, then the others", groups as differences from one more than the group before.
struct AttributeModels {
  AdaptiveModel<33> loose_count;
  AdaptiveModel<2> turned[2];
  AdaptiveModel<33> anchor_gap, group_step;
};

/// The order that anchor gaps count in.
std::vector<VertexId> anchor_order(const BoundaryLoops& loops, std::uint32_t vertex_count);

/// Maps signed to unsigned so that small magnitudes stay small: 0, -1, 1, -2 -> 0, 1, 2, 3.
inline std::uint32_t fold_sign(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
inline std::int32_t unfold_sign(std::uint32_t folded) {
  return static_cast<std::int32_t>(folded >> 1) ^ -static_cast<std::int32_t>(folded & 1);
}

}  // namespace selvage
