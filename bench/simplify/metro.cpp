// SPDX-License-Identifier: MIT
#include "bench/simplify/metro.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "server/simplify/point_triangle.h"

namespace selvage::bench {
namespace {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  double squared_distance(const Vec3& p) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max({low[axis] - p[axis], p[axis] - high[axis], 0.0});
      sum += d * d;
    }
    return sum;
  }
};

/// Nearest points by a tree of boxes, split in the middle of the longest side's order.
class NearestTriangle {
 public:
  explicit NearestTriangle(const TriangleSoup& soup) {
    for (const auto& [a, b, c] : soup.triangles) {
      triangles_.emplace_back(soup.positions[a], soup.positions[b], soup.positions[c]);
    }
    if (!triangles_.empty()) build(0, triangles_.size());
  }

  double distance(const Vec3& p) {
    double least = triangles_[last_].squared_distance(p);  // samples come in order: a good start
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
    return std::sqrt(least);
  }

 private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::uint32_t left = 0, right = 0;  // 0: a leaf
  };

  std::uint32_t build(std::size_t begin, std::size_t end) {
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
  static Vec3 middle_of(const PreparedTriangle& t) { return t.a + (t.ab + t.ac) * (1.0 / 3); }

  std::vector<PreparedTriangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> stack_;
  std::size_t last_ = 0;
};

/// Calls take(point) for the samples of a surface.
template <class Take>
void for_each_sample(const TriangleSoup& soup, std::size_t samples, Take take) {
  double area = 0;
  std::vector<bool> is_used(soup.positions.size(), false);
  for (const auto& [a, b, c] : soup.triangles) {
    area += length(cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a])) / 2;
    is_used[a] = is_used[b] = is_used[c] = true;
  }
  const double spacing = std::sqrt(area / static_cast<double>(samples));
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    if (is_used[v]) take(soup.positions[v]);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : soup.triangles) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      edges.insert(std::minmax(from, to));
    }
  }
  const auto steps_over = [&](double l) {
    return spacing > 0 ? static_cast<int>(std::min(l / spacing, 1e4)) + 1 : 1;
  };
  for (const auto& [from, to] : edges) {
    const Vec3 start = soup.positions[from], along = soup.positions[to] - start;
    const int steps = steps_over(length(along));
    for (int i = 1; i < steps; ++i) take(start + along * (double(i) / steps));
  }
  for (const auto& [a, b, c] : soup.triangles) {
    const Vec3 start = soup.positions[a], u = soup.positions[b] - start, v = soup.positions[c] - start;
    const double double_area = length(cross(u, v));
    if (double_area == 0) continue;
    // Rows parallel to the longest-known side, as far apart as samples in a row.
    const int rows = steps_over(double_area / std::max(length(u), 1e-300)), columns = steps_over(length(u));
    for (int row = 1; row < rows; ++row) {
      const double y = double(row) / rows;
      const int in_row = std::max(1, int(columns * (1 - y)));
      for (int i = 0; i < in_row; ++i) take(start + v * y + u * ((i + 0.5) / in_row * (1 - y)));
    }
  }
}

SurfaceDistance one_sided(const TriangleSoup& from, const TriangleSoup& to, std::size_t samples) {
  NearestTriangle nearest(to);
  SurfaceDistance result;
  std::size_t count = 0;
  for_each_sample(from, samples, [&](const Vec3& p) {
    const double d = nearest.distance(p);
    result.largest = std::max(result.largest, d);
    result.mean += d;
    ++count;
  });
  result.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
  return result;
}

}  // namespace

SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b, std::size_t samples) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  if (a.triangles.empty() || b.triangles.empty()) return {kFar, kFar};
  const SurfaceDistance there = one_sided(a, b, samples), back = one_sided(b, a, samples);
  return {std::max(there.largest, back.largest), std::max(there.mean, back.mean)};
}

double diagonal_of(const TriangleSoup& soup) {
  Box box;
  for (const Triangle& t : soup.triangles) {
    for (const std::uint32_t v : t) box.add(soup.positions[v]);
  }
  return soup.triangles.empty() ? 0 : length(box.high - box.low);
}

}  // namespace selvage::bench
