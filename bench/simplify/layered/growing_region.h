// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "bench/simplify/layered/split_mesh.h"
#include "common/codec/lanes.h"

namespace selvage::bench {

/// A region between two levels. Coordinates lack the low bits that the level in hand drops.
struct GrowingRegion {
  GrowingRegion(const CornerTable& base, std::uint32_t vertices, std::uint32_t triangles)
      : mesh(base, vertices, triangles), position(vertices), run(vertices), state(vertices) {
    for (const VertexId v : base.vertex_of_corner) ++state[v].degree;
    queue.reserve(vertices);
  }

  SplitMesh mesh;
  std::vector<IntLanes> position;
  /// Finest boundary indices that a vertex stands for, of one loop and counted in it; none inside.
  struct BoundaryRun {
    std::uint32_t loop = 0, begin = 0, length = 0;
  };
  std::vector<BoundaryRun> run;

  // Of the walk.
  enum History : std::uint8_t { NotAsked, LeftAlone, Split, New };
  struct VertexState {
    std::uint32_t degree = 0;  ///< triangles
    std::uint8_t history = NotAsked;
    bool is_queued = false;
    bool is_open = false;
  };
  std::vector<VertexState> state;
  std::vector<VertexId> queue;
};

}  // namespace selvage::bench
