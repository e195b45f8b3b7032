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
// Corner k of triangle t is 8t + k; vertices and turns of a triangle are half a cache line.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/codec/scratch.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// 8 * triangle + place in the triangle.
using FanCorner = std::uint32_t;

constexpr FanCorner next_on(FanCorner c) { return c + 1 - (c & 2) - ((c & 2) >> 1); }
constexpr FanCorner prev_on(FanCorner c) { return next_on(next_on(c)); }
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
  std::vector<Vertex> vertices;

  FanTable() = default;
  /// The same mesh. That fans are closed is left for the walk to find.
  explicit FanTable(const CornerTable& table);

  /// Becomes empty, with room for `triangles`.
  void start(std::uint32_t triangles);
  void make_room_for(std::uint32_t more_triangles);

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(used_ / kWords); }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(vertices.size()); }
  VertexId vertex(FanCorner c) const { return words_.data()[c]; }
  void prefetch(FanCorner c) const { __builtin_prefetch(words_.data() + c); }
  void set_vertex(FanCorner c, VertexId v) { words_.data()[c] = v; }
  /// The next corner on the rim of the fan that c is on the rim of; kNone past a border.
  FanCorner turn(FanCorner c) const { return words_.data()[c + kTurns]; }
  FanCorner opposite(FanCorner c) const { return turn(c) == kNone ? kNone : next_on(turn(c)); }
  /// The same vertex's corner in the next triangle clockwise; kNone past a border.
  FanCorner swing_cw(FanCorner c) const { return turn(prev_on(c)); }

  /// A triangle without neighbours; gives its first corner. There must be room.
  [[gnu::always_inline]] FanCorner add_triangle(VertexId a, VertexId b, VertexId c);
  [[gnu::always_inline]] void glue(FanCorner a, FanCorner b) {
    words_.data()[a + kTurns] = prev_on(b);
    words_.data()[b + kTurns] = prev_on(a);
  }
  /// Takes triangles away, given ascending; the last ones of those that stay move to the places that fall
  /// free, lowest place first. Gives former numbers. What `vertices` says of the corners of those that go
  /// is no longer known: 0 triangles; of the others, which corner is theirs.
  std::vector<TriangleId> drop(std::span<const TriangleId> dropped);

  /// The mesh with vertices renumbered. corner_of_vertex is left empty.
  CornerTable plain(std::span<const VertexId> number_of_vertex) const;

 private:
  void set_turn(FanCorner c, FanCorner to) { words_.data()[c + kTurns] = to; }
  void open_edge(FanCorner c);
  void move_triangle(TriangleId from, TriangleId to);

  static constexpr std::size_t kWords = 8, kTurns = 4;

  std::size_t used_ = 0;
  Scratch<std::uint32_t> words_;  ///< eight a triangle: three vertices, one unused, three turns, one unused
};

inline FanCorner FanTable::add_triangle(VertexId a, VertexId b, VertexId c) {
  std::uint32_t* words = words_.data() + used_;
  const auto first = static_cast<FanCorner>(used_);
  words[0] = a, words[1] = b, words[2] = c;
  words[kTurns] = words[kTurns + 1] = words[kTurns + 2] = words[kTurns + 3] = kNone;
  used_ += kWords;
  return first;
}

}  // namespace selvage
