// SPDX-License-Identifier: MIT
#include "server/segment/rings.h"

#include "server/segment/one_ring.h"

namespace selvage {

RingWalker::RingWalker(const CornerTable& mesh) : mesh_(mesh), stamp_of_vertex_(mesh.vertex_count(), 0) {}

Ring RingWalker::walk(VertexId v, int level) {
  if (level <= 1 || mesh_.is_border_vertex(v)) return one_ring(v);
  if (!grow_ball(v, level)) level = static_cast<int>(level_end_.size());
  for (; level > 1; --level) {
    if (!walk_border_of_ball(level_end_[level - 1])) continue;
    decimate(level);
    return {ring_, true};
  }
  return one_ring(v);
}

Ring RingWalker::one_ring(VertexId v) {
  ring_.clear();
  for_each_neighbour(mesh_, v, [&](VertexId u) { ring_.push_back(u); });
  return {ring_, !mesh_.is_border_vertex(v)};
}

/// Fills ball_ with the vertices at distance < level; level_end_[d] counts those at distance <= d. False if
/// the ball is too large: then level_end_ holds the whole levels only.
bool RingWalker::grow_ball(VertexId v, int level) {
  ++stamp_;
  ball_.assign(1, v);
  stamp_of_vertex_[v] = stamp_;
  level_end_.assign(1, 1);
  std::uint32_t visited = 0;
  for (std::size_t at = 0; static_cast<int>(level_end_.size()) < level;) {
    for (const std::size_t end = ball_.size(); at < end; ++at) {
      for_each_neighbour(mesh_, ball_[at], [&](VertexId u) {
        if (stamp_of_vertex_[u] != stamp_) ball_.push_back(u);
        stamp_of_vertex_[u] = stamp_;
        return ++visited <= kMaxCornersVisited;
      });
      if (visited > kMaxCornersVisited) return false;
    }
    level_end_.push_back(ball_.size());
  }
  return true;
}

bool RingWalker::touches_ball(TriangleId t) const {
  for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
    if (stamp_of_vertex_[mesh_.vertex(c)] == stamp_) return true;
  }
  return false;
}

/// Of a corner whose triangle touches the ball: does the edge that it faces bound the patch?
bool RingWalker::is_patch_border(CornerId c) const {
  const CornerId across = mesh_.opposite[c];
  return across == kNone || !touches_ball(triangle_of(across));
}

/// Walks the border of the triangles that touch the first `ball_size` vertices of ball_ into ring_. False if
/// it is not one loop. The border edges are counted first; a loop that uses them all is the only one.
bool RingWalker::walk_border_of_ball(std::size_t ball_size) {
  ++stamp_;
  for (std::size_t i = 0; i < ball_size; ++i) stamp_of_vertex_[ball_[i]] = stamp_;

  std::uint32_t border_edges = 0, visited = 0;
  CornerId start = kNone;
  for (std::size_t i = 0; i < ball_size && visited <= kMaxCornersVisited; ++i) {
    for_each_corner_at(mesh_, ball_[i], [&](CornerId at) {
      if (++visited > kMaxCornersVisited) return false;
      const CornerId first = 3 * triangle_of(at);
      for (CornerId c = first; c < at; ++c) {
        if (stamp_of_vertex_[mesh_.vertex(c)] == stamp_)
          return true;  // the triangle was counted at that corner
      }
      for (CornerId c = first; c < first + 3; ++c) {
        if (!is_patch_border(c)) continue;
        ++border_edges;
        if (start == kNone) start = c;
      }
      return true;
    });
  }
  if (start == kNone || visited > kMaxCornersVisited) return false;

  ring_.clear();
  CornerId c = start;  // faces the border edge next(c) -> prev(c)
  do {
    ring_.push_back(mesh_.vertex(next(c)));
    c = next(c);  // now the next edge that leaves prev(c), rotating inside the patch until it is a border
    while (!is_patch_border(c)) c = next(mesh_.opposite[c]);
  } while (c != start && ring_.size() <= border_edges);
  return ring_.size() == border_edges;
}

void RingWalker::decimate(int level) {
  constexpr std::size_t kMinSamples = 4;
  const std::size_t full = ring_.size(), step = static_cast<std::size_t>(level);
  if (full <= kMinSamples) return;
  if ((full + step - 1) / step >= kMinSamples) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < full; i += step) ring_[kept++] = ring_[i];
    ring_.resize(kept);
    return;
  }
  for (std::size_t i = 0; i < kMinSamples; ++i) ring_[i] = ring_[i * full / kMinSamples];
  ring_.resize(kMinSamples);
}

}  // namespace selvage
