// SPDX-License-Identifier: MIT
//
// A region's collapses as splits that can be done in many orders: what each takes from its vertex, and which
// others have to be done before it.
//
// A split opens two edges (at the end of an open star one). It has to wait for another only if that one makes
// its vertex, or one of the triangles at these edges, or a part of its run out of the same vertex's corners.
// All others only change what the vertices beside it are called.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/simplify/layered/split_mesh.h"
#include "common/mesh/corner_table.h"
#include "server/simplify/simplify.h"

namespace selvage::bench {

/// Corners are the finest region's.
struct PlannedSplit {
  VertexId from;  ///< the vertex that it makes
  SplitKind kind = SplitKind::Inner;
  /// The run of corners that `from` takes, counter-clockwise. An ear takes none, and comes next to `first`.
  CornerId first = kNone, last = kNone;
  bool is_ear = false;
  CornerId before = kNone, after = kNone;  ///< at `from`, of the new triangles: (u, v, w1), (u, w2, v)
  std::uint32_t boundary_run = 0;          ///< finest boundary vertices that `from` stands for
  std::uint32_t waits_for = 0;             ///< splits of the same layer
  std::vector<std::uint32_t> lets;         ///< splits that wait for this one
};

/// What leads from the next coarser level to this one.
struct Layer {
  std::vector<PlannedSplit> splits;  ///< in an order in which they may be done
  CornerTable coarse;                ///< corners and vertices numbered as in the finest, kNone where gone
};

/// `collapses` are the region's own in its numbers, `ends[k]` how many of them lead to level k; ends[0] = 0.
/// Finest layer first.
std::vector<Layer> plan_layers(const CornerTable& finest, std::span<const Collapse> collapses,
                               std::span<const std::uint32_t> ends);

}  // namespace selvage::bench
