// SPDX-License-Identifier: MIT
#include "common/samples/triangulate.h"

#include <cmath>

#include <gtest/gtest.h>

namespace selvage {
namespace {

using Loop2 = std::vector<Point2>;

Loop2 circle2(double x, double y, double radius, int points, int direction) {
  Loop2 loop;
  for (int i = 0; i < points; ++i) {
    const double angle = direction * 2 * 3.14159265358979 * i / points;
    loop.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return loop;
}

double area(const Loop2& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

/// Every triangle counter-clockwise, together the polygon's area, and as many as Euler's formula asks for.
void expect_triangulated(const std::vector<Loop2>& loops) {
  Loop2 points;
  double expected_area = 0;
  for (const Loop2& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    expected_area += area(loop);
  }
  double sum = 0;
  const auto triangles = triangulate(loops);
  for (const auto& [a, b, c] : triangles) {
    const double each = area({points[a], points[b], points[c]});
    EXPECT_GT(each, 0);
    sum += each;
  }
  EXPECT_NEAR(sum, expected_area, 1e-9 * expected_area);
  EXPECT_EQ(triangles.size(), points.size() + 2 * (loops.size() - 1) - 2);
}

TEST(Triangulate, FillsPolygonsWithAndWithoutHoles) {
  const Loop2 square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Loop2 comb = {{0, 0}, {9, 0}, {9, 5}, {8, 1}, {7, 5}, {6, 1}, {5, 5}, {4, 1}, {3, 5}, {2, 1}, {1, 5}};
  expect_triangulated({square});
  expect_triangulated({comb});
  expect_triangulated({circle2(0, 0, 5, 100, 1)});
  expect_triangulated({circle2(0, 0, 5, 100, 1), circle2(0, 0, 4.9, 60, -1)});
}

TEST(Triangulate, BridgesManyHolesInRowsAndColumns) {
  std::vector<Loop2> loops = {{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) loops.push_back(circle2(10 + 16 * x, 10 + 16 * y, 6, 12 + x + y, -1));
  expect_triangulated(loops);
}

}  // namespace
}  // namespace selvage
