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

  /// Glues the next triangle. False if no mesh has this symbol here: the stream is corrupt.
  bool grow(Clers symbol);

  /// Components that are complete or growing: one gate is left for each.
  std::uint32_t open_gates() const { return static_cast<std::uint32_t>(gates_.size()); }
  std::uint32_t triangle_count() const { return used_ / 3; }

  /// Closes the component whose gate is the `gate`-th by the triangle that the encoder started from. False if
  /// the component's border is not three edges.
  bool close(std::uint32_t gate);

  /// The grown connectivity. Vertices keep the numbers they grew with, among which those that were merged
  /// away are missing: they have no corner. The grower is spent.
  CornerTable take() &&;

 private:
  CornerId add_triangle(VertexId tip, VertexId after, VertexId before);
  VertexId add_vertex();
  void glue(CornerId a, CornerId b);
  bool is_open(CornerId c) const { return c != kNone && opposite_[c] == kNone; }
  CornerId left_branch_of_split();
  CornerId fan_end_ccw(CornerId c) const;
  CornerId fan_end_cw(CornerId c) const;
  VertexId merge(VertexId a, CornerId corner_a, VertexId b, CornerId corner_b);
  void rename_fan(CornerId any_corner, VertexId to);

  std::vector<HandleSplit> splits_;
  std::size_t next_split_ = 0;
  std::vector<CornerId> gates_;  ///< corners that face the open gates, the current one on top
  Clers last_ = Clers::E;
  CornerId used_ = 0;  ///< corners grown so far; both arrays are as long as was announced
  std::vector<VertexId> vertex_of_corner_;
  std::vector<CornerId> opposite_;
  std::vector<std::uint32_t> triangles_at_;  ///< by vertex: grown triangles around it; 0 once merged away
};

}  // namespace selvage
