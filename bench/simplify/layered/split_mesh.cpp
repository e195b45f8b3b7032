// SPDX-License-Identifier: MIT
#include "bench/simplify/layered/split_mesh.h"

#include <algorithm>

namespace selvage::bench {
namespace {

CornerId four(CornerId c) { return c == kNone ? kNone : c / 3 * 4 + c % 3; }
CornerId three(CornerId c) { return c == kNone ? kNone : c / 4 * 3 + c % 4; }

}  // namespace

SplitMesh::SplitMesh(const CornerTable& base, std::uint32_t vertices, std::uint32_t triangles)
    : vertex_of_corner_(4 * std::size_t{triangles}, kNone),
      opposite_(4 * std::size_t{triangles}, kNone),
      corner_of_vertex_(vertices, kNone),
      star_(triangles),
      vertex_count_(base.vertex_count()),
      triangle_count_(base.triangle_count()) {
  for (CornerId c = 0; c < base.corner_count(); ++c) {
    vertex_of_corner_[four(c)] = base.vertex(c);
    opposite_[four(c)] = four(base.opposite[c]);
  }
  for (VertexId v = 0; v < vertex_count_; ++v) corner_of_vertex_[v] = four(base.corner_of_vertex[v]);
}

VertexId SplitMesh::split(VertexId v, const Star& star, SplitKind kind, std::uint32_t begin,
                          std::uint32_t span) {
  if (span == 0) return add_ear(v, star, kind);
  const auto wrapped = [&](std::uint32_t i) { return i < star.size ? i : i - star.size; };
  const VertexId u = vertex_count_++;
  for (std::uint32_t i = begin; i < begin + span; ++i) vertex_of_corner_[star.corners[wrapped(i)]] = u;
  const CornerId first = star.corners[begin], last = star.corners[wrapped(begin + span - 1)];
  const CornerId before = prev(first), after = next(last);  // they face the edges that open
  CornerId towards_u = kNone;                               // of the first new triangle, faces u-v
  CornerId v_start = corner_of_vertex_[v], u_start = first;
  if (kind != SplitKind::AtStart) {
    // (u, v, w1)
    const CornerId t = 4 * triangle_count_++, beyond = opposite_[before];
    vertex_of_corner_[t] = u;
    vertex_of_corner_[t + 1] = v;
    vertex_of_corner_[t + 2] = vertex_of_corner_[next(first)];
    join(t, beyond);
    join(t + 1, before);
    towards_u = t + 2;
    opposite_[towards_u] = kNone;
    if (begin == 0 || begin + span > star.size) v_start = t + 1;  // v's first corner went to u
    if (kind == SplitKind::AtEnd) u_start = t;
  }
  if (kind != SplitKind::AtEnd) {
    // (u, w2, v)
    const CornerId t = 4 * triangle_count_++, beyond = opposite_[after];
    vertex_of_corner_[t] = u;
    vertex_of_corner_[t + 1] = vertex_of_corner_[prev(last)];
    vertex_of_corner_[t + 2] = v;
    join(t, beyond);
    join(t + 2, after);
    if (towards_u != kNone) {
      join(t + 1, towards_u);
    } else {
      opposite_[t + 1] = kNone;
      v_start = t + 2;
    }
    // w2 begins with its triangle most clockwise.
    if (beyond == kNone) corner_of_vertex_[vertex_of_corner_[t + 1]] = t + 1;
  }
  corner_of_vertex_[v] = v_start;
  corner_of_vertex_[u] = u_start;
  return u;
}

VertexId SplitMesh::add_ear(VertexId v, const Star& star, SplitKind kind) {
  const bool is_at_end = kind == SplitKind::AtEnd;
  const CornerId facing = is_at_end ? next(star.corners[star.size - 1]) : prev(star.corners[0]);
  const VertexId w = vertex_of_corner_[is_at_end ? next(facing) : prev(facing)];
  const VertexId u = vertex_count_++;
  const CornerId t = 4 * triangle_count_++;
  vertex_of_corner_[t] = u;
  vertex_of_corner_[t + 1] = is_at_end ? v : w;
  vertex_of_corner_[t + 2] = is_at_end ? w : v;
  join(t, facing);
  opposite_[t + 1] = opposite_[t + 2] = kNone;
  corner_of_vertex_[vertex_of_corner_[t + 2]] = t + 2;
  corner_of_vertex_[u] = t;
  return u;
}

std::vector<Triangle> SplitMesh::triangles() const {
  std::vector<Triangle> triangles(triangle_count_);
  for (TriangleId t = 0; t < triangle_count_; ++t)
    triangles[t] = {vertex_of_corner_[4 * t], vertex_of_corner_[4 * t + 1], vertex_of_corner_[4 * t + 2]};
  return triangles;
}

CornerTable SplitMesh::plain() const {
  CornerTable table;
  table.vertex_of_corner.resize(3 * std::size_t{triangle_count_});
  table.opposite.resize(3 * std::size_t{triangle_count_});
  table.corner_of_vertex.resize(vertex_count_);
  for (TriangleId t = 0; t < triangle_count_; ++t) {
    for (CornerId k = 0; k < 3; ++k) {
      table.vertex_of_corner[3 * t + k] = vertex_of_corner_[4 * t + k];
      table.opposite[3 * t + k] = three(opposite_[4 * t + k]);
    }
  }
  for (VertexId v = 0; v < vertex_count_; ++v) table.corner_of_vertex[v] = three(corner_of_vertex_[v]);
  return table;
}

}  // namespace selvage::bench
