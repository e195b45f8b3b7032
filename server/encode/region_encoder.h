// SPDX-License-Identifier: MIT
//
// One region in, one region part out (docs/FORMAT.md, "Region part"). Needs nothing from other regions, so
// regions are encoded in parallel.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"
#include "common/coding/byte_io.h"
#include "common/coding/entropy_encoder.h"
#include "common/mesh/grid.h"

namespace selvage {

/// What makes a region a coarser level of another.
struct CoarseSource {
  std::span<const std::uint32_t> finest_loop_lengths;
  std::span<const VertexId> vertex_of_boundary;  ///< by the finest level's boundary index, local vertex
  GridBox finest_box;
  int dropped_bits = 0;  ///< low bits of coordinates to leave out
};

/// A region cut out of the model, in the encoder's own (local) numbering.
struct RegionSource {
  CornerTable table;  ///< interior triangles; 2-manifold with boundary, any loops, genus, pieces
  std::vector<GridPoint> positions;        ///< by local vertex
  std::vector<bool> is_turned;             ///< by local triangle; empty if none is
  std::vector<std::uint32_t> weld_groups;  ///< by local vertex, kNone where it is no anchor; empty if none is
  std::vector<ExactPosition> exact;        ///< by local vertex in a bit-exact model, else empty
  Grid grid;                               ///< needed only then
  std::optional<CoarseSource> coarse = std::nullopt;
};

struct EncodedRegion {
  Bytes bytes;
  GridBox box;                             ///< of all positions, or the finest level's; the decoder needs it
  std::vector<VertexId> source_of_vertex;  ///< local vertex, by the decoder's vertex number
  BoundaryLoops loops;                ///< in the decoder's numbers: what (region, boundary index) counts in
  std::size_t connectivity_size = 0;  ///< bytes of the part, give or take a few
};

/// Coordinates must be within [0, 2^24) and, of a coarser level, within the finest's box. A source without
/// triangles is the loose pseudo-region. Only training and benchmarks pass tables of their own, and ask for
/// the symbols that the part was coded from.
EncodedRegion encode_region(const RegionSource& source, const CodecTables& tables = shipped_tables(),
                            EntropyEncoder* symbols = nullptr);

}  // namespace selvage
