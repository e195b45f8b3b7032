// SPDX-License-Identifier: MIT
#include "common/codec/fan_table.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

#include "common/codec/lanes.h"

namespace selvage {
namespace {

/// The corners opposite, as CornerTable counts them, from where they lead.
IntLanes plain_opposites(IntLanes turns) {
  const IntLanes second = turns & 2, opposites = turns + 1 - second - (second >> 1),
                 triangles = opposites >> 3;
  return (opposites - 4 * triangles - triangles) | (turns == -1);
}

}  // namespace

FanTable::FanTable(const CornerTable& table) {
  start(table.triangle_count());
  vertices.resize(table.vertex_count());
  for (TriangleId t = 0; t < table.triangle_count(); ++t) {
    const Triangle triangle = table.triangle(t);
    const FanCorner first = add_triangle(triangle[0], triangle[1], triangle[2]);
    for (CornerId k = 0; k < 3; ++k) {
      const CornerId across = table.opposite[3 * t + k];
      if (across != kNone && across < 3 * t + k) glue(first + k, fan_corner(across));
      ++vertices[triangle[k]].triangles;
      vertices[triangle[k]].corner = first + k;
    }
  }
}

void FanTable::start(std::uint32_t triangles) {
  // A mesh without border has one more a component than what grows it announces; there may be some.
  constexpr std::size_t kClosing = 32;
  words_.make(kWords * (triangles + kClosing));
  used_ = 0;
  vertices.clear();
  vertices.reserve(triangles / 2 + 3);
}

void FanTable::make_room_for(std::uint32_t more_triangles) {
  words_.grow(used_ + kWords * std::size_t{more_triangles}, used_);
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
      vertices[vertex(c)].triangles = 0;
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

CornerTable FanTable::plain(std::span<const VertexId> number_of_vertex) const {
  CornerTable table;
  table.vertex_of_corner.reserve(3 * std::size_t{triangle_count()});
  table.opposite.reserve(3 * std::size_t{triangle_count()});
  // In pieces: vectors that grow by what is there need not be cleared first.
  constexpr std::size_t kPiece = 128;
  std::array<VertexId, 3 * kPiece> numbers;
  std::array<CornerId, 3 * kPiece + 1> opposites;  // the lane to spare goes where the next triangle comes
  for (TriangleId t = 0; t < triangle_count();) {
    const std::size_t piece = std::min<std::size_t>(kPiece, triangle_count() - t);
    const std::uint32_t* words = words_.data() + kWords * t;
    for (std::size_t i = 0; i < piece; ++i, words += kWords) {
      for (std::size_t k = 0; k < 3; ++k) numbers[3 * i + k] = number_of_vertex[words[k]];
      IntLanes turns;
      std::memcpy(&turns, words + kTurns - 1, sizeof turns);
      turns = plain_opposites(__builtin_shufflevector(turns, turns, 1, 2, 3, 0));
      std::memcpy(&opposites[3 * i], &turns, sizeof turns);
    }
    table.vertex_of_corner.insert(table.vertex_of_corner.end(), numbers.data(), numbers.data() + 3 * piece);
    table.opposite.insert(table.opposite.end(), opposites.data(), opposites.data() + 3 * piece);
    t += static_cast<TriangleId>(piece);
  }
  return table;
}

}  // namespace selvage
