// SPDX-License-Identifier: MIT
#include "common/codec/fan_walk.h"

namespace selvage {

FanWalk::FanWalk(const FanTable& table, std::uint32_t most_vertices, Memory& memory)
    : table_(table),
      most_vertices_(most_vertices),
      corners_left_(3 * std::size_t{table.triangle_count()}),
      states_(memory.states.make(table.vertex_count())),
      well_(memory.well.make(table.vertex_count() + 1)),
      once_(memory.once.make(table.vertex_count() + 1)),
      rim_of_visited_(memory.rims.make(most_vertices)) {
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    const std::uint32_t triangles = table.vertices[v].closed_fan();
    states_[v] = kUnvisited + (triangles <= kSteps ? triangles : 0);
  }
}

void FanWalk::turn_slowly() {
  unsigned triangles = 0, collected = 0;
  std::uint64_t unknown = 0;
  const auto turn_from = [&](FanCorner first) {
    triangles = collected = 0;
    unknown = 0;
    for (FanCorner rim = first;;) {
      const std::uint32_t state = states_[table_.vertex(rim)];
      ring_.rims[Ring::kFirst - collected] = rim;
      ring_.states[Ring::kFirst - collected] = state;
      ++triangles;
      if (collected < Ring::kMost) {
        unknown = unknown * 2 + (state >> 31);
        ++collected;
      }
      const FanCorner turned = table_.turn(rim);
      if (turned == kNone) return rim;
      if (turned == first) return kNone;
      rim = turned;
    }
  };
  FanCorner last = turn_from(next_on(current_));
  ring_.is_border = last != kNone;
  if (ring_.is_border) {  // once more, from the clockwise end
    FanCorner first = prev_on(next_on(current_));
    for (FanCorner cw = table_.swing_cw(first); cw != kNone; cw = table_.swing_cw(first)) first = cw;
    last = turn_from(next_on(first));
    const std::uint32_t state = states_[table_.next_vertex(last)];
    ring_.states[Ring::kFirst - collected] = state;
    unknown = unknown * 2 + (state >> 31);
    border_.push_back(count_);
  }
  corners_left_ -= triangles;
  ring_.neighbours = collected + ring_.is_border;
  // Cut short, a fan is open where it was cut.
  const bool is_open = ring_.is_border || collected < triangles;
  if (ring_.neighbours > Ring::kMost) ring_.neighbours = Ring::kMost, unknown >>= 1;
  ring_.triangles = ring_.neighbours - is_open;
  ring_.unknown = unknown << (Ring::kFirst + 1 - ring_.neighbours);
  if (!is_open) ring_.states[Ring::kFirst - ring_.neighbours] = ring_.states[Ring::kFirst];
}

CornerTable FanWalk::plain_table() const {
  CornerTable table = table_.plain(std::span(states_, table_.vertex_count()));
  table.corner_of_vertex.resize(count_);
  for (VertexId v = 0; v < count_; ++v) {
    const FanCorner corner = prev_on(rim_of_visited_[v]);
    table.corner_of_vertex[v] = corner - 5 * triangle_on(corner);
  }
  return table;
}

}  // namespace selvage
