// SPDX-License-Identifier: MIT
#include "common/codec/fan_table.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace selvage {

void FanTable::start(std::uint32_t triangles) {
  // A mesh without border has one more a component than what grows it announces; there may be some.
  constexpr std::size_t kClosing = 32;
  words_.make(kWords * (triangles + kClosing));
  used_ = vertex_count_ = 0;
  vertex_room_ = triangles / 2 + kClosing;
  vertices_.make(vertex_room_);
}

void FanTable::make_room_for(std::uint32_t more_triangles) {
  words_.grow(used_ + kWords * std::size_t{more_triangles}, used_);
}

void FanTable::make_room_for_vertices() {
  vertex_room_ += vertex_room_ / 2;
  vertices_.grow(vertex_room_, vertex_count_);
}

void FanTable::open_edge(FanCorner c) {
  if (turn(c) == kNone) return;
  set_turn(opposite(c), kNone);
  set_turn(c, kNone);
}

void FanTable::move_triangle(TriangleId from, TriangleId to) {
  for (FanCorner k = 0; k < 3; ++k) {
    const FanCorner source = 8 * from + k, target = 8 * to + k, across = opposite(source);
    set_vertex(target, vertex(source));
    if (across == kNone) {
      set_turn(target, kNone);
    } else {
      glue(target, across);
    }
  }
}

std::vector<TriangleId> FanTable::drop(std::span<const TriangleId> dropped) {
  std::vector<TriangleId> former(triangle_count());
  std::iota(former.begin(), former.end(), TriangleId{0});
  for (TriangleId t : dropped) {
    for (FanCorner c = 8 * t; c < 8 * t + 3; ++c) {
      open_edge(c);
      at(vertex(c)).triangles = 0;
    }
  }
  TriangleId end = triangle_count();
  for (std::size_t low = 0, high = dropped.size(); low < high; ++low) {
    while (low < high && dropped[high - 1] == end - 1) --high, --end;
    if (low == high) break;
    move_triangle(--end, dropped[low]);
    former[dropped[low]] = end;
  }
  former.resize(end);
  used_ = kWords * end;
  return former;
}

std::vector<Triangle> FanTable::triangles(std::span<const VertexId> number_of_vertex) const {
  std::vector<Triangle> triangles;
  triangles.reserve(triangle_count());
  // In pieces: a vector that grows by what is there need not be cleared first.
  std::array<Triangle, 128> piece;
  const std::uint32_t* words = words_.data();
  while (triangles.size() < triangle_count()) {
    const std::size_t count = std::min(piece.size(), triangle_count() - triangles.size());
    for (std::size_t i = 0; i < count; ++i, words += kWords) {
      for (std::size_t k = 0; k < 3; ++k) piece[i][k] = number_of_vertex[words[k]];
    }
    triangles.insert(triangles.end(), piece.begin(), piece.begin() + count);
  }
  return triangles;
}

}  // namespace selvage
