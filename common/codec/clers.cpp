// SPDX-License-Identifier: MIT
#include "common/codec/clers.h"

namespace selvage {

ClersGrower::ClersGrower(std::vector<HandleSplit> splits, std::uint32_t triangles)
    : splits_(std::move(splits)) {
  vertex_of_corner_.reserve(3 * std::size_t{triangles});
  opposite_.reserve(3 * std::size_t{triangles});
  vertices_.reserve(triangles / 2 + 3);
}

bool ClersGrower::split(CornerId gate) {
  const VertexId tail = vertex_of_corner_[gate + 1], head = vertex_of_corner_[gate + 2];
  const CornerId left = left_branch_of_split();
  if (left == kNone || left == gate || !is_open(left)) return false;
  const VertexId left_tail = vertex_of_corner_[next(left)], left_head = vertex_of_corner_[prev(left)];
  if (left_head == tail || left_head == head || left_tail == tail || left_tail == head) return false;
  const CornerId arriving = vertices_[tail].arriving;
  const VertexId joined = merge(tail, gate + 1, left_head, prev(left));
  vertices_[joined].arriving = arriving;
  const CornerId tip = add_triangle(joined, left_tail, head);
  glue(tip + 1, gate);
  glue(tip + 2, left);
  vertices_[head].arriving = tip;
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
  // The border u -> v -> w -> u, the component on its left, backwards.
  const VertexId u = vertex_of_corner_[facing_uv + 1], v = vertex_of_corner_[facing_uv + 2];
  const CornerId facing_wu = vertices_[u].arriving;
  const VertexId w = vertex_of_corner_[next(facing_wu)];
  const CornerId facing_vw = vertices_[w].arriving;
  if (vertex_of_corner_[next(facing_vw)] != v || w == u || v == u) return false;
  const CornerId tip = add_triangle(w, v, u);
  glue(tip, facing_uv);
  glue(tip + 1, facing_wu);
  glue(tip + 2, facing_vw);
  vertices_[w].arriving = tip, vertices_[v].arriving = tip + 1, vertices_[u].arriving = tip + 2;
  return true;
}

/// By pieces that are still in the cache when they are filled.
void ClersGrower::make_room() {
  constexpr std::size_t kPiece = 3 * 256;
  const std::size_t announced = vertex_of_corner_.capacity();
  // Only triangles that close components go beyond what was announced.
  const std::size_t size = used_ < announced ? std::min(used_ + kPiece, announced) : used_ + 3;
  vertex_of_corner_.resize(size);
  opposite_.resize(size, kNone);
}

CornerTable ClersGrower::take() && {
  CornerTable table;
  vertex_of_corner_.resize(used_);
  opposite_.resize(used_);
  table.vertex_of_corner = std::move(vertex_of_corner_);
  table.opposite = std::move(opposite_);
  table.corner_of_vertex.reserve(vertices_.size());
  for (VertexId v = 0; v < vertices_.size(); ++v) {
    const CornerId c = vertices_[v].triangles > 0 ? vertices_[v].arriving : kNone;
    const bool is_border = c != kNone && table.vertex(c) != v;
    table.corner_of_vertex.push_back(is_border ? prev(c) : c);
  }
  return table;
}

/// Joins two open fans into one vertex. The smaller one is renamed, so all merges together take O(n log n).
VertexId ClersGrower::merge(VertexId a, CornerId corner_a, VertexId b, CornerId corner_b) {
  const bool keeps_a = vertices_[a].triangles >= vertices_[b].triangles;
  const VertexId kept = keeps_a ? a : b, gone = keeps_a ? b : a;
  rename_fan(keeps_a ? corner_b : corner_a, kept);
  vertices_[kept].triangles += vertices_[gone].triangles;
  vertices_[gone].triangles = 0;
  return kept;
}

void ClersGrower::rename_fan(CornerId any_corner, VertexId to) {
  CornerId c = any_corner;
  for (CornerId across = opposite_[prev(c)]; across != kNone; across = opposite_[prev(c)]) c = prev(across);
  while (c != kNone) {
    vertex_of_corner_[c] = to;
    const CornerId across = opposite_[next(c)];
    c = across == kNone ? kNone : next(across);
  }
}

}  // namespace selvage
