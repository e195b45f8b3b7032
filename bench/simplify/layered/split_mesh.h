// SPDX-License-Identifier: MIT
//
// A region's connectivity while it grows by vertex splits, the inverse of half-edge collapses [Hoppe 1996]:
//
//        x                   x            v gives the fan between w1 and w2 to the new vertex u; the edges
//      /   \               / | \          v-w1 and v-w2 open, and a triangle comes into each. At the end of
//    w2     w1           w2--u--w1        an open star only one edge opens, and u is on the border.
//      \   /               \ | /
//        v                   v
//
// Corners are four a triangle, of which the last means nothing, so that next() needs no division.
#pragma once

#include <cstdint>
#include <vector>

#include "common/codec/lanes.h"
#include "common/mesh/corner_table.h"

namespace selvage::bench {

/// Where the split vertex's run of corners lies.
enum class SplitKind : std::uint8_t {
  None,
  Inner,    ///< u is inside, with two triangles of its own
  AtStart,  ///< of an open star, its most clockwise end; u follows v on the border
  AtEnd,    ///< u precedes v on the border
};

class SplitMesh {
 public:
  struct Star {
    const CornerId* corners;  ///< counter-clockwise; an open star's from its border
    std::uint32_t size;
    bool is_open;
  };

  /// Room for what the region will have at last.
  SplitMesh(const CornerTable& base, std::uint32_t vertices, std::uint32_t triangles);

  static CornerId next(CornerId c) { return (c & 3) == 2 ? c - 2 : c + 1; }
  static CornerId prev(CornerId c) { return (c & 3) == 0 ? c + 2 : c - 1; }

  std::uint32_t vertex_count() const { return vertex_count_; }
  std::uint32_t triangle_count() const { return triangle_count_; }
  VertexId vertex(CornerId c) const { return vertex_of_corner_[c]; }
  CornerId opposite(CornerId c) const { return opposite_[c]; }

  /// Valid until the next call.
  Star star(VertexId v) {
    const CornerId first = corner_of_vertex_[v];
    CornerId c = first;
    std::uint32_t size = 0;
    do {
      star_[size++] = c;
      const CornerId across = opposite_[next(c)];
      if (across == kNone) return {star_.data(), size, true};
      c = next(across);
    } while (c != first);
    return {star_.data(), size, false};
  }

  /// Corners `begin` to `begin + span` of v's star, cyclically in a closed one, go to a new vertex, whose
  /// number comes back. Needs the star as gathered last, and a run that leaves v a triangle, or, in an open
  /// star split inside, takes all. At an end the run may be empty: the new triangle is an ear at the border.
  VertexId split(VertexId v, const Star& star, SplitKind kind, std::uint32_t begin, std::uint32_t span);

  std::vector<Triangle> triangles() const;
  CornerTable plain() const;

 private:
  VertexId add_ear(VertexId v, const Star& star, SplitKind kind);
  void join(CornerId a, CornerId b) {
    opposite_[a] = b;
    if (b != kNone) opposite_[b] = a;
  }

  std::vector<VertexId> vertex_of_corner_;
  std::vector<CornerId> opposite_;
  std::vector<CornerId> corner_of_vertex_;
  std::vector<CornerId> star_;
  std::uint32_t vertex_count_, triangle_count_;
};

}  // namespace selvage::bench
