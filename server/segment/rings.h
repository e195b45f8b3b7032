// SPDX-License-Identifier: MIT
//
// The extended multi-ring (XMR) neighbourhood of the dissertation, Def. 4.4 and Fig. 4.6: instead of its
// direct neighbours a vertex v sees the vertices at edge distance L, so that what is measured on it does not
// depend on the smallest triangles of a finely sampled surface.
//
// The text leaves three things open, decided here as follows.
//  - Which vertices: those at distance L (the text's formula forgets to leave out V_{L-1}).
//  - In which order: along the border of the triangles that touch a vertex at distance < L, walked with these
//    triangles on the left, so that (v, ring[i], ring[i+1]) are the counter-clockwise faces F_L.
//  - Where that border is not one loop (near mesh borders, on thin handles) or where the patch is larger than
//    kMaxCornersVisited (next to a vertex of enormous valence): the largest smaller L that works. L = 1
//    always does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

/// The ring around one vertex. The span lives until the walker's next call.
struct Ring {
  std::span<const VertexId> vertices;
  bool is_closed = true;  ///< false at a mesh border: no face between the last and the first vertex
};

/// Walks rings; keeps scratch memory (4 bytes a vertex) between calls. One per thread.
class RingWalker {
 public:
  explicit RingWalker(const CornerTable& mesh);

  /// The ring of `v` at level `level` >= 1 after factor-L decimation (Fig. 4.6 b): every L-th vertex is kept,
  /// but at least four, evenly spaced, where the full ring has them. A border vertex gets its 1-ring.
  Ring walk(VertexId v, int level);

 private:
  static constexpr std::uint32_t kMaxCornersVisited = 2048;

  Ring one_ring(VertexId v);
  bool grow_ball(VertexId v, int level);
  bool walk_border_of_ball(std::size_t ball_size);
  void decimate(int level);
  bool touches_ball(TriangleId t) const;
  bool is_patch_border(CornerId c) const;

  const CornerTable& mesh_;
  std::vector<std::uint32_t> stamp_of_vertex_;  // == stamp_: in the ball
  std::uint32_t stamp_ = 0;
  std::vector<VertexId> ball_;          // vertices at distance < L, in the order of their distance
  std::vector<std::size_t> level_end_;  // level_end_[d]: how many lie at distance <= d
  std::vector<VertexId> ring_;
};

}  // namespace selvage
