// SPDX-License-Identifier: MIT
#include "common/codec/clers.h"

#include <algorithm>

namespace selvage {

ClersGrower::ClersGrower(std::vector<HandleSplit> splits, std::uint32_t triangles)
    : splits_(std::move(splits)) {
  vertex_of_corner_.resize(3 * std::size_t{triangles});
  opposite_.resize(3 * std::size_t{triangles}, kNone);
  triangles_at_.reserve(triangles / 2 + 3);
}

unsigned ClersGrower::context() const {
  constexpr unsigned kCounts = region_model::kClersCounts;
  const unsigned last = static_cast<unsigned>(last_) * kCounts * kCounts;
  if (gates_.empty()) return last;
  const CornerId gate = gates_.back();
  const unsigned tail = std::min(triangles_at_[vertex_of_corner_[next(gate)]], kCounts) - 1;
  const unsigned head = std::min(triangles_at_[vertex_of_corner_[prev(gate)]], kCounts) - 1;
  return last + tail * kCounts + head;
}

bool ClersGrower::grow(Clers symbol) {
  last_ = symbol;
  if (symbol == Clers::E) {
    const VertexId tip = add_vertex(), after = add_vertex(), before = add_vertex();
    gates_.push_back(add_triangle(tip, after, before));
    return true;
  }
  if (gates_.empty() || !is_open(gates_.back())) return false;
  const CornerId gate = gates_.back();
  const VertexId tail = vertex_of_corner_[next(gate)], head = vertex_of_corner_[prev(gate)];
  CornerId tip = kNone;
  switch (symbol) {
    case Clers::R:
      tip = add_triangle(head, tail, add_vertex());
      glue(prev(tip), gate);
      break;
    case Clers::L:
      tip = add_triangle(tail, add_vertex(), head);
      glue(next(tip), gate);
      break;
    case Clers::C: {
      // The tail's fan is open between the gate and the border edge at its other end; the triangle closes it.
      const CornerId across_left = next(fan_end_ccw(next(gate)));
      const VertexId after = vertex_of_corner_[next(across_left)];
      if (!is_open(across_left) || after == head) return false;
      tip = add_triangle(tail, after, head);
      glue(next(tip), gate);
      glue(prev(tip), across_left);
      break;
    }
    case Clers::S: {
      const CornerId left = left_branch_of_split();
      if (!is_open(left) || left == gate) return false;
      const VertexId left_tail = vertex_of_corner_[next(left)], left_head = vertex_of_corner_[prev(left)];
      const bool repeats = left_head == tail || left_head == head || left_tail == tail || left_tail == head;
      if (repeats) return false;
      const VertexId joined = merge(tail, next(gate), left_head, prev(left));
      tip = add_triangle(joined, left_tail, head);
      glue(next(tip), gate);
      glue(prev(tip), left);
      break;
    }
    case Clers::E:
      break;
  }
  gates_.back() = tip;
  return true;
}

CornerId ClersGrower::left_branch_of_split() {
  if (next_split_ < splits_.size() && splits_[next_split_].split == triangle_count()) {
    const HandleSplit& handle = splits_[next_split_++];
    return handle.source < triangle_count() ? 3 * handle.source + (handle.is_left ? 2 : 1) : kNone;
  }
  if (gates_.size() < 2) return kNone;
  const CornerId left = gates_[gates_.size() - 2];
  gates_.pop_back();
  return left;
}

bool ClersGrower::close(std::uint32_t gate) {
  const CornerId facing_uv = gates_[gate];
  if (!is_open(facing_uv)) return false;
  // Walk the border u -> v -> w -> u, the component on its left.
  const CornerId at_v = fan_end_cw(prev(facing_uv)), at_w = fan_end_cw(next(at_v));
  const VertexId u = vertex_of_corner_[next(facing_uv)], v = vertex_of_corner_[at_v],
                 w = vertex_of_corner_[at_w];
  if (vertex_of_corner_[next(at_w)] != u || w == u || v == u) return false;
  const CornerId facing_vw = prev(at_v), facing_wu = prev(at_w);
  const CornerId tip = add_triangle(w, v, u);
  glue(tip, facing_uv);
  glue(next(tip), facing_wu);
  glue(prev(tip), facing_vw);
  return true;
}

CornerTable ClersGrower::take() && {
  CornerTable table;
  vertex_of_corner_.resize(used_);
  opposite_.resize(used_);
  table.vertex_of_corner = std::move(vertex_of_corner_);
  table.opposite = std::move(opposite_);
  table.set_corner_of_vertex(static_cast<std::uint32_t>(triangles_at_.size()));
  return table;
}

CornerId ClersGrower::add_triangle(VertexId tip, VertexId after, VertexId before) {
  if (used_ ==
      vertex_of_corner_.size()) {  // only triangles that close components go beyond what was announced
    vertex_of_corner_.resize(used_ + 3);
    opposite_.resize(used_ + 3, kNone);
  }
  const CornerId corner = used_;
  used_ += 3;
  VertexId* vertices = &vertex_of_corner_[corner];
  vertices[0] = tip;
  vertices[1] = after;
  vertices[2] = before;
  for (VertexId v : {tip, after, before}) ++triangles_at_[v];
  return corner;
}

VertexId ClersGrower::add_vertex() {
  triangles_at_.push_back(0);
  return static_cast<VertexId>(triangles_at_.size() - 1);
}

void ClersGrower::glue(CornerId a, CornerId b) {
  opposite_[a] = b;
  opposite_[b] = a;
}

CornerId ClersGrower::fan_end_ccw(CornerId c) const {
  for (CornerId across = opposite_[next(c)]; across != kNone; across = opposite_[next(c)]) c = next(across);
  return c;
}

CornerId ClersGrower::fan_end_cw(CornerId c) const {
  for (CornerId across = opposite_[prev(c)]; across != kNone; across = opposite_[prev(c)]) c = prev(across);
  return c;
}

/// Joins two open fans into one vertex. The smaller one is renamed, so all merges together take O(n log n).
VertexId ClersGrower::merge(VertexId a, CornerId corner_a, VertexId b, CornerId corner_b) {
  const bool keeps_a = triangles_at_[a] >= triangles_at_[b];
  const VertexId kept = keeps_a ? a : b, gone = keeps_a ? b : a;
  rename_fan(keeps_a ? corner_b : corner_a, kept);
  triangles_at_[kept] += triangles_at_[gone];
  triangles_at_[gone] = 0;
  return kept;
}

void ClersGrower::rename_fan(CornerId any_corner, VertexId to) {
  for (CornerId c = fan_end_cw(any_corner); c != kNone;) {
    vertex_of_corner_[c] = to;
    const CornerId across = opposite_[next(c)];
    c = across == kNone ? kNone : next(across);
  }
}

}  // namespace selvage
