// SPDX-License-Identifier: MIT
#include "common/render/rasterise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace selvage {
namespace {

/// A quantity that is linear over the picture: value(x, y) = at_origin + x * per_x + y * per_y.
struct Plane {
  double at_origin, per_x, per_y;
  double at(double x, double y) const { return at_origin + x * per_x + y * per_y; }
};

/// Positive on the left of the edge from a to b (with y downwards: on the inside of a clockwise triangle).
Plane edge(const Projected& a, const Projected& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return {a.x * -dy + a.y * dx, dy, -dx};
}

int clamped(double v, int size) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size))); }

bool is_finite(const Projected& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.nearness);
}

void draw(VisibleTriangles& seen, TriangleId id, Projected a, Projected b, Projected c) {
  double area = edge(a, b).at(c.x, c.y);
  if (area < 0) {
    std::swap(b, c);
    area = -area;
  }
  if (!(area > 0)) return;
  // Sample (i, j) is at (i + 0.5, j + 0.5).
  const int x0 = clamped(std::ceil(std::min({a.x, b.x, c.x}) - 0.5), seen.width);
  const int x1 = clamped(std::floor(std::max({a.x, b.x, c.x}) - 0.5) + 1, seen.width);
  const int y0 = clamped(std::ceil(std::min({a.y, b.y, c.y}) - 0.5), seen.height);
  const int y1 = clamped(std::floor(std::max({a.y, b.y, c.y}) - 0.5) + 1, seen.height);
  if (x0 >= x1 || y0 >= y1) return;

  const Plane ea = edge(b, c), eb = edge(c, a), ec = edge(a, b);
  const double ia = a.nearness / area, ib = b.nearness / area, ic = c.nearness / area;
  for (int y = y0; y < y1; ++y) {
    double wa = ea.at(x0 + 0.5, y + 0.5), wb = eb.at(x0 + 0.5, y + 0.5), wc = ec.at(x0 + 0.5, y + 0.5);
    std::size_t at = static_cast<std::size_t>(y) * seen.width + x0;
    for (int x = x0; x < x1; ++x, ++at, wa += ea.per_x, wb += eb.per_x, wc += ec.per_x) {
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const auto nearness = static_cast<float>(wa * ia + wb * ib + wc * ic);
      if (nearness <= seen.nearness[at]) continue;
      seen.nearness[at] = nearness;
      seen.triangle[at] = id;
    }
  }
}

}  // namespace

VisibleTriangles rasterise(std::span<const Projected> points, std::span<const Triangle> triangles, int width,
                           int height) {
  const std::size_t samples = static_cast<std::size_t>(width) * height;
  VisibleTriangles seen{width, height, std::vector<TriangleId>(samples, kNone),
                        std::vector<float>(samples, std::numeric_limits<float>::lowest())};
  for (TriangleId t = 0; t < triangles.size(); ++t) {
    const Projected &a = points[triangles[t][0]], &b = points[triangles[t][1]], &c = points[triangles[t][2]];
    if (is_finite(a) && is_finite(b) && is_finite(c)) draw(seen, t, a, b, c);
  }
  return seen;
}

}  // namespace selvage
