// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/result.h"
#include "common/codec/codec_tables.h"
#include "common/codec/geometry_walk.h"
#include "common/codec/region_mesh.h"
#include "common/mesh/grid.h"

namespace selvage {

/// What the directory says of a region's level that is not the finest.
struct CoarseLevel {
  std::span<const std::uint32_t> finest_loop_lengths;  ///< what boundary indices count in
  int dropped_bits = 0;                                ///< low bits of coordinates that the level leaves out
};

/// What the directory promised about a region; the decoder gives exactly that or an error.
struct DecodeLimits {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  GridPoint box_min, box_max;  ///< of all positions, inclusive, within [0, 2^24)
  std::optional<Grid> exact;   ///< the grid of a bit-exact model, nothing for others and for coarser levels
  std::optional<CoarseLevel> coarse = std::nullopt;  ///< nothing for the finest level
};

/// The most heap memory that decode_region takes at once, the result included, whatever the bytes.
std::uint64_t decode_memory_bound(const DecodeLimits& expected);

/// Decodes one region from `bytes`. Needs nothing from other regions. Safe on hostile input: reads only
/// `bytes`, and takes no more than decode_memory_bound, nor any of it before it knows that so few bytes may
/// hold so much (docs/FORMAT.md, "Limits"). Boundary vertices come out in encoder order, which is the order
/// that bundles refer to. `tables` must be those that it was coded with; only benchmarks pass others.
Result<RegionMesh> decode_region(std::span<const std::byte> bytes, const DecodeLimits& expected,
                                 const CodecTables& tables = shipped_tables());

/// The same for one region after another: keeps the memory that the largest one took. One for each thread.
class RegionDecoder {
 public:
  Result<RegionMesh> decode(std::span<const std::byte> bytes, const DecodeLimits& expected,
                            const CodecTables& tables = shipped_tables());

 private:
  FanTable table_;
  GeometryWalk::Memory memory_;
};

}  // namespace selvage
