// SPDX-License-Identifier: MIT
#include "bench/simplify/nearest_triangle.h"

namespace selvage::bench {
namespace {

Vec3 middle_of(const PreparedTriangle& t) { return t.a + (t.ab + t.ac) * (1.0 / 3); }

}  // namespace

NearestTriangle::NearestTriangle(const TriangleSoup& soup) {
  for (const auto& [a, b, c] : soup.triangles) {
    triangles_.emplace_back(soup.positions[a], soup.positions[b], soup.positions[c]);
  }
  if (!triangles_.empty()) build(0, triangles_.size());
}

std::uint32_t NearestTriangle::build(std::size_t begin, std::size_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, begin, end});
  Box box, middles;
  for (std::size_t i = begin; i < end; ++i) {
    const PreparedTriangle& t = triangles_[i];
    for (const Vec3& corner : {t.a, t.a + t.ab, t.a + t.ac}) box.add(corner);
    middles.add(middle_of(t));
  }
  nodes_[id].box = box;
  if (end - begin <= 4) return id;
  int axis = 0;
  for (int other : {1, 2}) {
    if (middles.high[other] - middles.low[other] > middles.high[axis] - middles.low[axis]) axis = other;
  }
  const std::size_t middle = (begin + end) / 2;
  std::nth_element(triangles_.begin() + std::ptrdiff_t(begin), triangles_.begin() + std::ptrdiff_t(middle),
                   triangles_.begin() + std::ptrdiff_t(end),
                   [&](const auto& a, const auto& b) { return middle_of(a)[axis] < middle_of(b)[axis]; });
  const std::uint32_t left = build(begin, middle), right = build(middle, end);
  nodes_[id].left = left;
  nodes_[id].right = right;
  return id;
}

const PreparedTriangle& NearestTriangle::nearest(const Vec3& p) {
  double least = triangles_[last_].squared_distance(p);
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    if (node.box.squared_distance(p) >= least) continue;
    if (node.left == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const double d = triangles_[i].squared_distance(p);
        if (d < least) least = d, last_ = i;
      }
      continue;
    }
    const bool left_first =
        nodes_[node.left].box.squared_distance(p) < nodes_[node.right].box.squared_distance(p);
    stack_.push_back(left_first ? node.right : node.left);
    stack_.push_back(left_first ? node.left : node.right);
  }
  return triangles_[last_];
}

}  // namespace selvage::bench
