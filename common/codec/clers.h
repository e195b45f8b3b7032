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
#include "common/codec/fan_table.h"

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

/// Corner numbering of every grown triangle t: 8t is the tip, 8t+1 and 8t+2 follow counter-clockwise. So the
/// gate is opposite 8t, the right edge opposite 8t+1, the left edge opposite 8t+2.
class ClersGrower {
 public:
  /// Grows the mesh in `table`, which starts anew with room for `triangles`; the caller has bounded them.
  /// Vertices that were merged away keep their number and have no triangles. `splits` ascending by `split`.
  ClersGrower(std::vector<HandleSplit> splits, std::uint32_t triangles, FanTable& table);

  /// The model of the next symbol: by the last symbol and how many triangles surround the gate's two ends.
  unsigned context() const { return context_; }

  /// Glues the next of the announced triangles. False if no mesh has this symbol here: the stream is corrupt.
  bool grow(Clers symbol);

  /// After the last symbol: how many components there are. One gate is left for each.
  std::uint32_t finish();

  /// Closes the component whose gate is the `gate`-th by the triangle that the encoder started from. False if
  /// the component's border is not three edges.
  bool close(std::uint32_t gate);

 private:
  // A vertex of the growing border has one open fan, and so one border edge that arrives at it; its corner is
  // the one that faces this edge.
  FanCorner& arriving(VertexId v) { return table_.at(v).corner; }
  FanCorner arriving(VertexId v) const { return table_.at(v).corner; }

  std::uint32_t triangles(VertexId v) const { return table_.at(v).triangles; }
  static unsigned context_after(Clers last, std::uint32_t around_tail, std::uint32_t around_head);
  void close_fan(VertexId v, FanCorner own);
  std::uint32_t add_to_fan(VertexId v);
  std::uint32_t add_to_fan(VertexId v, FanCorner arriving);
  bool is_open(FanCorner c) const { return arriving(table_.vertex(prev_on(c))) == c; }
  bool split(FanCorner gate);
  FanCorner left_branch_of_split();
  VertexId merge(VertexId a, FanCorner corner_a, VertexId b, FanCorner corner_b);
  void rename_fan(FanCorner any_corner, VertexId to);

  FanTable& table_;
  std::vector<HandleSplit> splits_;
  std::size_t next_split_ = 0;
  FanCorner gate_ = kNone;                ///< the tip that faces the current gate
  std::vector<FanCorner> gates_;          ///< the others that are open; the one to come back to on top
  VertexId tail_ = kNone, head_ = kNone;  ///< of the current gate
  unsigned context_ = context_after(Clers::E, 1, 1);
};

inline unsigned ClersGrower::context_after(Clers last, std::uint32_t around_tail, std::uint32_t around_head) {
  constexpr unsigned kCounts = region_model::kClersCounts;
  return (static_cast<unsigned>(last) * kCounts + std::min(around_tail, kCounts) - 1) * kCounts +
         std::min(around_head, kCounts) - 1;
}

/// Its border is used up by a triangle that has this corner there.
inline void ClersGrower::close_fan(VertexId v, FanCorner own) {
  table_.at(v) = {(triangles(v) + 1) | FanTable::Vertex::kIsInside, own};
}

/// Gives how many triangles the fan has now; with the border edge that arrives at v.
inline std::uint32_t ClersGrower::add_to_fan(VertexId v) { return ++table_.at(v).triangles; }
inline std::uint32_t ClersGrower::add_to_fan(VertexId v, FanCorner arriving) {
  const std::uint32_t count = triangles(v) + 1;
  table_.at(v) = {count, arriving};
  return count;
}

// The gate runs from tail to head, and the new triangle's tip corner faces the next gate.
//
// Each case says what comes next in constants: so the next symbol's model follows from which case is taken,
// which processors guess right, and need not wait for the symbol.
[[gnu::always_inline]] inline bool ClersGrower::grow(Clers symbol) {
  if (symbol == Clers::E) {
    const VertexId tip = table_.vertex_count();
    tail_ = tip + 1, head_ = tip + 2;
    const FanCorner corner = table_.add_triangle(tip, tail_, head_);
    table_.add_vertex({1, corner + 1});
    table_.add_vertex({1, corner + 2});
    table_.add_vertex({1, corner});
    if (gate_ != kNone) gates_.push_back(gate_);
    gate_ = corner;
    context_ = context_after(Clers::E, 1, 1);
    return true;
  }
  // A handle may have used up the edge that waits here.
  if (gate_ == kNone || arriving(head_) != gate_) return false;
  const FanCorner gate = gate_;
  if (symbol == Clers::C) {
    // The triangle closes the tail's fan: between the gate and the border edge that arrives at the tail.
    const FanCorner left = arriving(tail_);
    const VertexId after = table_.next_vertex(left);
    if (after == head_) return false;
    const FanCorner tip = table_.add_triangle(tail_, after, head_);
    table_.glue_new_to_first<1>(tip, gate);
    table_.glue_new<2>(tip, left);
    close_fan(tail_, tip);
    gate_ = tip;
    tail_ = after;
    const std::uint32_t around_tail = add_to_fan(tail_);
    context_ = context_after(Clers::C, around_tail, add_to_fan(head_, tip));
    return true;
  }
  if (symbol == Clers::R) {
    const VertexId v = table_.vertex_count();
    const FanCorner tip = table_.add_triangle(head_, tail_, v);
    table_.glue_new_to_first<2>(tip, gate);
    table_.add_vertex({1, tip});
    add_to_fan(head_, tip + 1);
    gate_ = tip;
    head_ = v;
    context_ = context_after(Clers::R, add_to_fan(tail_), 1);
    return true;
  }
  if (symbol == Clers::L) {
    const VertexId v = table_.vertex_count();
    const FanCorner tip = table_.add_triangle(tail_, v, head_);
    table_.glue_new_to_first<1>(tip, gate);
    table_.add_vertex({1, tip + 2});
    add_to_fan(tail_);
    gate_ = tip;
    tail_ = v;
    context_ = context_after(Clers::L, 1, add_to_fan(head_, tip));
    return true;
  }
  return split(gate);
}

}  // namespace selvage
