// SPDX-License-Identifier: MIT
#include "common/codec/clers.h"

namespace selvage {

ClersGrower::ClersGrower(std::vector<HandleSplit> splits, std::uint32_t triangles, FanTable& table)
    : table_(table), splits_(std::move(splits)) {
  table_.start(triangles);
}

bool ClersGrower::split(FanCorner gate) {
  const VertexId tail = tail_, head = head_;
  const FanCorner left = left_branch_of_split();
  if (left == kNone || left == gate || !is_open(left)) return false;
  const VertexId left_tail = table_.next_vertex(left), left_head = table_.vertex(prev_on(left));
  if (left_head == tail || left_head == head || left_tail == tail || left_tail == head) return false;
  const FanCorner arriving_at_tail = arriving(tail);
  const VertexId joined = merge(tail, gate + 1, left_head, prev_on(left));
  const FanCorner tip = table_.add_triangle(joined, left_tail, head);
  table_.glue(tip + 1, gate);
  table_.glue(tip + 2, left);
  add_to_fan(joined, arriving_at_tail);
  gate_ = tip;
  tail_ = left_tail;
  const std::uint32_t around_tail = add_to_fan(tail_);
  context_ = context_after(Clers::S, around_tail, add_to_fan(head, tip));
  return true;
}

FanCorner ClersGrower::left_branch_of_split() {
  const std::uint32_t grown = table_.triangle_count();
  if (next_split_ < splits_.size() && splits_[next_split_].split == grown) {
    const HandleSplit& handle = splits_[next_split_++];
    return handle.source < grown ? 8 * handle.source + (handle.is_left ? 2 : 1) : kNone;
  }
  if (gates_.empty()) return kNone;
  const FanCorner left = gates_.back();
  gates_.pop_back();
  return left;
}

std::uint32_t ClersGrower::finish() {
  if (gate_ != kNone) gates_.push_back(gate_);
  const auto components = static_cast<std::uint32_t>(gates_.size());
  table_.make_room_for(components);
  return components;
}

bool ClersGrower::close(std::uint32_t gate) {
  const FanCorner facing_uv = gates_[gate];
  if (!is_open(facing_uv)) return false;
  // The border u -> v -> w -> u, the component on its left, backwards.
  const VertexId u = table_.vertex(facing_uv + 1), v = table_.vertex(facing_uv + 2);
  const FanCorner facing_wu = arriving(u);
  const VertexId w = table_.next_vertex(facing_wu);
  const FanCorner facing_vw = arriving(w);
  if (table_.next_vertex(facing_vw) != v || w == u || v == u) return false;
  const FanCorner tip = table_.add_triangle(w, v, u);
  table_.glue(tip, facing_uv);
  table_.glue(tip + 1, facing_wu);
  table_.glue(tip + 2, facing_vw);
  close_fan(w, tip), close_fan(v, tip + 1), close_fan(u, tip + 2);
  return true;
}

/// Joins two open fans into one vertex. The smaller one is renamed, so all merges together take O(n log n).
VertexId ClersGrower::merge(VertexId a, FanCorner corner_a, VertexId b, FanCorner corner_b) {
  const bool keeps_a = triangles(a) >= triangles(b);
  const VertexId kept = keeps_a ? a : b, gone = keeps_a ? b : a;
  rename_fan(keeps_a ? corner_b : corner_a, kept);
  table_.at(kept).triangles += triangles(gone);
  table_.at(gone).triangles = 0;
  return kept;
}

void ClersGrower::rename_fan(FanCorner any_corner, VertexId to) {
  FanCorner c = any_corner;
  for (FanCorner cw = table_.swing_cw(c); cw != kNone; cw = table_.swing_cw(c)) c = cw;
  for (FanCorner rim = next_on(c); rim != kNone; rim = table_.turn(rim)) table_.set_vertex(prev_on(rim), to);
}

}  // namespace selvage
