// SPDX-License-Identifier: MIT
#include "common/codec/fan_walk.h"

namespace selvage {

FanWalk::FanWalk(const FanTable& table, std::uint32_t most_vertices, Memory& memory)
    : table_(table),
      memory_(memory),
      most_vertices_(most_vertices),
      corners_left_(3 * std::size_t{table.triangle_count()}),
      states_(memory.states.make(table.vertex_count())),
      queue_end_{memory.once.make(table.vertex_count()), memory.well.make(table.vertex_count()), &nowhere_},
      queue_next_{queue_end_[kOnceQueue], queue_end_[kWellQueue]} {
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    const std::uint32_t triangles = table.at(v).closed_fan();
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
    border_.push_back({count_, table_.vertex(next_on(first))});
  }
  corners_left_ -= triangles;
  ring_.neighbours = collected + ring_.is_border;
  // Cut short, a fan is open where it was cut.
  const bool is_open = ring_.is_border || collected < triangles;
  if (ring_.neighbours > Ring::kMost) ring_.neighbours = Ring::kMost, unknown >>= 1;
  ring_.triangles = ring_.neighbours - is_open;
  ring_.set_unknown(unknown << (Ring::kFirst + 1 - ring_.neighbours), Ring::first_ones(ring_.neighbours),
                    Ring::first_ones(ring_.triangles));
  if (!is_open) ring_.states[Ring::kFirst - ring_.neighbours] = ring_.states[Ring::kFirst];
}

std::vector<Triangle> FanWalk::triangles() const {
  return table_.triangles(std::span(states_, table_.vertex_count()));
}

BoundaryLoops FanWalk::boundary_loops() {
  BoundaryLoops loops;
  loops.vertices.reserve(border_.size());
  // Nothing is queued any more; a queue serves to find border vertices by their number.
  VertexId* place_of_number = memory_.once.data();
  for (VertexId place = 0; place < border_.size(); ++place) place_of_number[border_[place].number] = place;
  std::vector<bool> is_listed(border_.size());
  for (VertexId start = 0; start < border_.size(); ++start) {
    if (is_listed[start]) continue;
    const std::size_t begin = loops.vertices.size();
    for (VertexId place = start; !is_listed[place]; place = place_of_number[states_[border_[place].next]]) {
      is_listed[place] = true;
      loops.vertices.push_back(border_[place].number);
    }
    loops.lengths.push_back(static_cast<std::uint32_t>(loops.vertices.size() - begin));
  }
  return loops;
}

}  // namespace selvage
