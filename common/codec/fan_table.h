// SPDX-License-Identifier: MIT
//
// Connectivity as the codec grows it and walks around its vertices: a corner table laid out for turning.
//
//          d-----b          The corners on the rim of v's fan, counter-clockwise: that of triangle (v, a, b)
//          at
//           \   / \         a, that of (v, b, d) at b, and so on. turn() leads from each to the next: it is
//            \ /   \        what lies opposite, turned back once. So one load makes a step of the turn, and
//             v-----a       nothing waits for a division by three.
//
// Corner k of triangle t is 8t + k; vertices and turns of a triangle are half a cache line:
//
//   vertices of corners 0, 1, 2, and 0 again | turns of corner 2, then of 0, 1, 2
//
// So what belongs to the next corner, or its turn to the one before, is a word away whichever corner it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/codec/scratch.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// 8 * triangle + place in the triangle.
using FanCorner = std::uint32_t;

/// Place 3, where a triangle's first vertex is repeated, counts as place 0.
constexpr FanCorner next_on(FanCorner c) { return c + 1 - (c & 2) - ((c & 2) >> 1); }
constexpr FanCorner prev_on(FanCorner c) { return c + 2 - 3 * ((c | c >> 1) & 1); }
constexpr TriangleId triangle_on(FanCorner c) { return c >> 3; }
constexpr FanCorner fan_corner(CornerId c) { return 8 * (c / 3) + c % 3; }

class FanTable {
 public:
  /// More would not fit into the numbers of corners.
  static constexpr std::uint32_t kMostTriangles = 1u << 27;

  struct Vertex {
    std::uint32_t triangles = 0;  ///< around it, plus kIsInside; 0 if it is no vertex of the mesh any more
    FanCorner corner = kNone;     ///< the grower's; of a vertex inside, one of its own
    static constexpr std::uint32_t kIsInside = 1u << 31;
    /// Triangles of a fan that is known to be closed, else 0.
    std::uint32_t closed_fan() const { return triangles >= kIsInside ? triangles - kIsInside : 0; }
  };

  /// Becomes empty, with room for `triangles`.
  void start(std::uint32_t triangles);
  void make_room_for(std::uint32_t more_triangles);

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(used_ / kWords); }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(vertex_count_); }
  Vertex& at(VertexId v) { return vertices_.data()[v]; }
  const Vertex& at(VertexId v) const { return vertices_.data()[v]; }
  VertexId vertex(FanCorner c) const { return words_.data()[c]; }
  VertexId next_vertex(FanCorner c) const { return words_.data()[c + 1]; }
  void prefetch(FanCorner c) const { __builtin_prefetch(words_.data() + c); }
  void set_vertex(FanCorner c, VertexId v) {
    words_.data()[c] = v;
    if (c % kWords == 0) words_.data()[c + 3] = v;
  }
  /// The next corner on the rim of the fan that c is on the rim of; kNone past a border.
  FanCorner turn(FanCorner c) const { return words_.data()[c + kTurns]; }
  FanCorner turn_of_prev(FanCorner c) const { return words_.data()[c + kTurns - 1]; }
  FanCorner opposite(FanCorner c) const { return turn(c) == kNone ? kNone : next_on(turn(c)); }
  /// The same vertex's corner in the next triangle clockwise; kNone past a border.
  FanCorner swing_cw(FanCorner c) const { return turn_of_prev(c); }

  /// There is always room for one more.
  [[gnu::always_inline]] void add_vertex(Vertex vertex);
  /// A triangle without neighbours; gives its first corner. There must be room.
  [[gnu::always_inline]] FanCorner add_triangle(VertexId a, VertexId b, VertexId c);
  void glue(FanCorner a, FanCorner b) {
    set_turn(a, prev_on(b));
    set_turn(b, prev_on(a));
  }
  /// The same for corner `kPlace` of the triangle that begins at `first`, and for the corner at which a
  /// triangle begins: what needs no computing is not computed.
  template <FanCorner kPlace>
  [[gnu::always_inline]] void glue_new(FanCorner first, FanCorner to) {
    set_turn_of_new<kPlace>(first, prev_on(to));
    set_turn(to, first + (kPlace + 2) % 3);
  }
  template <FanCorner kPlace>
  [[gnu::always_inline]] void glue_new_to_first(FanCorner first, FanCorner to) {
    set_turn_of_new<kPlace>(first, to + 2);
    words_.data()[to + kTurns] = first + (kPlace + 2) % 3;
  }
  /// Takes triangles away, given ascending; the last ones of those that stay move to the places that fall
  /// free, lowest place first. Gives former numbers. What vertices say is no longer known: of the corners of
  /// those that go, 0 triangles; of the others, which corner is theirs.
  std::vector<TriangleId> drop(std::span<const TriangleId> dropped);

  /// The triangles, their vertices renumbered.
  std::vector<Triangle> triangles(std::span<const VertexId> number_of_vertex) const;

 private:
  /// Both words are written, without a jump: they are the same one but for the last corner.
  [[gnu::always_inline]] void set_turn(FanCorner c, FanCorner to) {
    const FanCorner is_last = c >> 1 & 1;
    words_.data()[c + kTurns] = words_.data()[c + kTurns - 3 * is_last] = to;
  }
  template <FanCorner kPlace>
  void set_turn_of_new(FanCorner first, FanCorner to) {
    words_.data()[first + kTurns + kPlace] = to;
    if (kPlace == 2) words_.data()[first + kTurns - 1] = to;
  }
  void make_room_for_vertices();
  void open_edge(FanCorner c);
  void move_triangle(TriangleId from, TriangleId to);

  static constexpr std::size_t kWords = 8, kTurns = 5;

  std::size_t used_ = 0, vertex_count_ = 0, vertex_room_ = 0;
  Scratch<std::uint32_t> words_;
  Scratch<Vertex> vertices_;
};

inline void FanTable::add_vertex(Vertex vertex) {
  if (vertex_count_ == vertex_room_) [[unlikely]]
    make_room_for_vertices();
  vertices_.data()[vertex_count_++] = vertex;
}

inline FanCorner FanTable::add_triangle(VertexId a, VertexId b, VertexId c) {
  std::uint32_t* words = words_.data() + used_;
  const auto first = static_cast<FanCorner>(used_);
  words[0] = words[3] = a, words[1] = b, words[2] = c;
  words[4] = words[5] = words[6] = words[7] = kNone;
  used_ += kWords;
  return first;
}

}  // namespace selvage
