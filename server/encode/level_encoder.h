// SPDX-License-Identifier: MIT
//
// One level coarser than the finest, region by region.
#pragma once

#include <span>
#include <vector>

#include "common/codec/codec_tables.h"
#include "common/coding/byte_io.h"
#include "common/coding/entropy_encoder.h"
#include "common/pack/directory.h"
#include "server/encode/model_encoder.h"

namespace selvage {

class LevelEncoder {
 public:
  /// Everything is borrowed. `weld_group_of_vertex` as find_weld_groups gives it; `level` > 0. Linear time.
  LevelEncoder(const ModelSource& source, const Grid& grid,
               std::span<const std::uint32_t> weld_group_of_vertex, std::size_t level);

  /// The region's part, not the loose one's. `finest` has its box and loops, `boundary_vertices` the finest
  /// mesh's vertices by boundary index. Regions may be encoded at once.
  Bytes encode(RegionId region, const RegionEntry& finest, std::span<const VertexId> boundary_vertices,
               const CodecTables& tables, EntropyEncoder* symbols) const;

 private:
  CornerTable cut_table(const RegionLevel& level) const;

  const ModelSource& source_;
  const Grid& grid_;
  std::span<const std::uint32_t> weld_group_of_vertex_;
  std::span<const VertexId> representative_of_vertex_;
  std::span<const RegionLevel> regions_;
  std::vector<std::uint32_t> local_of_vertex_;    ///< place in its region's vertices; kNone if it is gone
  std::vector<std::uint32_t> local_of_triangle_;  ///< the same; kNone for boundary triangles, too
};

}  // namespace selvage
