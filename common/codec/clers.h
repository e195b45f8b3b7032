// SPDX-License-Identifier: MIT
//
// Edgebreaker's symbols [Ros99; dissertation Ch. 5.1.1] and the machine that turns them back into a mesh.
//
// The encoder conquers the mesh triangle by triangle through a gate (the edge it enters by) and notes what it
// finds at the tip v opposite to the gate:
//
//            v                    C  v is new                           -> go right
//           / \                   L  left triangle is visited or border -> go right
//     left /   \ right            R  right triangle is visited          -> go left
//         /     \                 S  both are open, v is not new        -> go right, left later
//        *--gate--*               E  both are visited                   -> back to the last S
//
// Symbols are sent last first [Isenburg and Snoeyink 2000, Spirale Reversi]: read that way each one glues a
// triangle onto what is already there, so no split needs an offset, and the decoder knows how many triangles
// already surround the gate's ends, which is what the entropy model wants to know.
//
// The encoder runs the same ClersGrower over its own symbols; so contexts, triangle order and vertex numbers
// agree on both sides by construction.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/codec/codec_tables.h"
#include "common/mesh/corner_table.h"

namespace selvage {

enum class Clers : std::uint8_t { C, L, E, R, S };
inline constexpr int kClersCount = 5;

/// One end of a handle: the left side of the S triangle `split` is glued to an edge of the triangle `source`,
/// which comes before it in decoding order, instead of to a branch of its own. Both count in decoding order.
struct HandleSplit {
  std::uint32_t split = 0;
  std::uint32_t source = 0;
  bool is_left = false;  ///< the edge of `source` is its left one, else its right one
};

/// Corner numbering of every grown triangle t: 3t is the tip, 3t+1 and 3t+2 follow counter-clockwise. So the
/// gate is opposite 3t, the right edge opposite 3t+1, the left edge opposite 3t+2.
class ClersGrower {
 public:
  /// `splits` ascending by `split`. Makes room for `triangles`, which the caller has bounded.
  ClersGrower(std::vector<HandleSplit> splits, std::uint32_t triangles);

  /// The model of the next symbol: by the last symbol and how many triangles surround the gate's two ends.
  unsigned context() const;

  /// Glues the next of the announced triangles. False if no mesh has this symbol here: the stream is corrupt.
  bool grow(Clers symbol);

  /// Components that are complete or growing: one gate is left for each.
  std::uint32_t open_gates() const { return static_cast<std::uint32_t>(gates_.size()); }
  std::uint32_t triangle_count() const { return used_ / 3; }

  /// Closes the component whose gate is the `gate`-th by the triangle that the encoder started from. False if
  /// the component's border is not three edges.
  bool close(std::uint32_t gate);

  /// The grown connectivity. Vertices keep the numbers they grew with; those that were merged away have no
  /// corner. Those on the border have any corner in corner_of_vertex. The grower is spent.
  CornerTable take() &&;

 private:
  /// A vertex of the growing border has one open fan, and so one border edge that arrives at it.
  struct GrownVertex {
    std::uint32_t triangles = 0;  ///< grown around it; 0 once merged away
    CornerId arriving = kNone;    ///< faces that edge; inside the mesh, one of the vertex's own corners
  };

  CornerId add_triangle(VertexId tip, VertexId after, VertexId before);
  void make_room();
  VertexId add_vertex();
  void glue(CornerId a, CornerId b) { opposite_[a] = b, opposite_[b] = a; }
  bool is_open(CornerId c) const { return vertices_[vertex_of_corner_[prev(c)]].arriving == c; }
  bool split(CornerId gate);
  CornerId left_branch_of_split();
  VertexId merge(VertexId a, CornerId corner_a, VertexId b, CornerId corner_b);
  void rename_fan(CornerId any_corner, VertexId to);

  std::vector<HandleSplit> splits_;
  std::size_t next_split_ = 0;
  std::vector<CornerId> gates_;  ///< tips that face the open gates, the current one on top
  Clers last_ = Clers::E;
  CornerId used_ = 0;  ///< corners grown so far; both arrays are a little ahead
  std::vector<VertexId> vertex_of_corner_;
  std::vector<CornerId> opposite_;
  std::vector<GrownVertex> vertices_;
};

inline unsigned ClersGrower::context() const {
  constexpr unsigned kCounts = region_model::kClersCounts;
  const unsigned last = static_cast<unsigned>(last_) * kCounts * kCounts;
  if (gates_.empty()) return last;
  const CornerId gate = gates_.back();
  const unsigned tail = std::min(vertices_[vertex_of_corner_[gate + 1]].triangles, kCounts) - 1;
  const unsigned head = std::min(vertices_[vertex_of_corner_[gate + 2]].triangles, kCounts) - 1;
  return last + tail * kCounts + head;
}

inline CornerId ClersGrower::add_triangle(VertexId tip, VertexId after, VertexId before) {
  if (used_ == vertex_of_corner_.size()) [[unlikely]]
    make_room();
  const CornerId corner = used_;
  used_ += 3;
  VertexId* vertices = &vertex_of_corner_[corner];
  vertices[0] = tip;
  vertices[1] = after;
  vertices[2] = before;
  for (VertexId v : {tip, after, before}) ++vertices_[v].triangles;
  return corner;
}

inline VertexId ClersGrower::add_vertex() {
  vertices_.push_back({});
  return static_cast<VertexId>(vertices_.size() - 1);
}

// In all cases the gate runs from tail to head, and the new triangle's tip corner faces the next gate.
[[gnu::always_inline]] inline bool ClersGrower::grow(Clers symbol) {
  last_ = symbol;
  if (symbol == Clers::E) {
    const VertexId tip = add_vertex(), after = add_vertex(), before = add_vertex();
    const CornerId corner = add_triangle(tip, after, before);
    vertices_[before].arriving = corner;
    vertices_[tip].arriving = corner + 1;
    vertices_[after].arriving = corner + 2;
    gates_.push_back(corner);
    return true;
  }
  // A handle may have used up the edge that waits here.
  if (gates_.empty() || !is_open(gates_.back())) return false;
  const CornerId gate = gates_.back();
  const VertexId tail = vertex_of_corner_[gate + 1], head = vertex_of_corner_[gate + 2];
  if (symbol == Clers::C) {
    // The triangle closes the tail's fan: between the gate and the border edge that arrives at the tail.
    const CornerId arriving = vertices_[tail].arriving;
    const VertexId after = vertex_of_corner_[next(arriving)];
    if (after == head) return false;
    const CornerId tip = add_triangle(tail, after, head);
    glue(tip + 1, gate);
    glue(tip + 2, arriving);
    vertices_[tail].arriving = tip;
    vertices_[head].arriving = tip;
    gates_.back() = tip;
    return true;
  }
  if (symbol == Clers::R) {
    const VertexId v = add_vertex();
    const CornerId tip = add_triangle(head, tail, v);
    glue(tip + 2, gate);
    vertices_[v].arriving = tip;
    vertices_[head].arriving = tip + 1;
    gates_.back() = tip;
    return true;
  }
  if (symbol == Clers::L) {
    const VertexId v = add_vertex();
    const CornerId tip = add_triangle(tail, v, head);
    glue(tip + 1, gate);
    vertices_[v].arriving = tip + 2;
    vertices_[head].arriving = tip;
    gates_.back() = tip;
    return true;
  }
  return split(gate);
}

}  // namespace selvage
