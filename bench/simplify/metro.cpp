// SPDX-License-Identifier: MIT
#include "bench/simplify/metro.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bench/simplify/nearest_triangle.h"

namespace selvage::bench {
namespace {

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
