// SPDX-License-Identifier: MIT
#include "server/simplify/surface_cover.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/mesh/corner_table.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// The largest distance of many points of `from` to `to`, one triangle of which is nearest to each.
double sampled_distance(const TriangleSoup& from, const TriangleSoup& to) {
  std::mt19937 random(1);
  const auto share = [&] { return static_cast<double>(random() % 1000) / 999; };
  double largest = 0;
  for (const auto& [a, b, c] : from.triangles) {
    for (int i = 0; i < 15; ++i) {
      // Corners first: on the rim of an open surface they are farthest.
      double u = i == 1 ? 1 : i < 3 ? 0 : share(), v = i == 2 ? 1 : i < 2 ? 0 : share();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = from.positions[a] + (from.positions[b] - from.positions[a]) * u +
                     (from.positions[c] - from.positions[a]) * v;
      double least = HUGE_VAL;
      for (const auto& [x, y, z] : to.triangles) {
        const PreparedTriangle triangle(to.positions[x], to.positions[y], to.positions[z]);
        least = std::min(least, triangle.squared_distance(p));
      }
      largest = std::max(largest, std::sqrt(least));
    }
  }
  return largest;
}

double bound_of(const TriangleSoup& from, const TriangleSoup& to, double begin) {
  const auto vertices = static_cast<std::uint32_t>(to.positions.size());
  const CornerTable table = build_corner_table(to.triangles, vertices);
  const NearSurface surface(to.triangles, to.positions, table.opposite);
  const CoverTarget target{&surface};
  CoverBound bound({&target, 1}, begin);
  for (const auto& [a, b, c] : from.triangles)
    bound.add(from.positions[a], from.positions[b], from.positions[c]);
  return bound.bound();
}

TriangleSoup scaled(TriangleSoup soup, double by) {
  for (Vec3& p : soup.positions) p = p * by;
  return soup;
}

TEST(SurfaceCover, BoundsTheDistanceClosely) {
  const TriangleSoup coarse = scaled(shapes::sphere(1), 1000), fine = scaled(shapes::sphere(4), 1000);
  const TriangleSoup torus = scaled(shapes::torus(8, 20), 100), other = scaled(shapes::torus(13, 31), 100);
  const std::pair<const TriangleSoup*, const TriangleSoup*> pairs[] = {
      {&coarse, &fine}, {&fine, &coarse}, {&torus, &other}, {&other, &torus}};
  for (const auto& [from, to] : pairs) {
    const double sampled = sampled_distance(*from, *to), bound = bound_of(*from, *to, 0.01);
    EXPECT_GE(bound, sampled * (1 - 1e-9));
    EXPECT_LE(bound, sampled * 1.12);
  }
}

TEST(SurfaceCover, SeesThatPiecesOfOnePlaneCoverOneAnother) {
  TriangleSoup fine = scaled(shapes::grid(37, 23), 100), coarse;
  for (Vec3& p : fine.positions) p.z = 7;
  for (const Vec3& corner : {Vec3{0, 0, 7}, Vec3{3700, 0, 7}, Vec3{3700, 2300, 7}, Vec3{0, 2300, 7}})
    coarse.positions.push_back(corner);
  coarse.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(bound_of(fine, coarse, 0.01), 0.01);
  EXPECT_EQ(bound_of(coarse, fine, 0.01), 0.01);
}

TEST(SurfaceCover, StaysWhereItBeganIfNothingIsFarther) {
  const TriangleSoup sphere = scaled(shapes::sphere(3), 1000);
  EXPECT_EQ(bound_of(sphere, sphere, 0.25), 0.25);
}

}  // namespace
}  // namespace selvage
