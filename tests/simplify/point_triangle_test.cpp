// SPDX-License-Identifier: MIT
#include "server/simplify/point_triangle.h"

#include <random>

#include <gtest/gtest.h>

namespace selvage {
namespace {

/// By sampling the triangle.
double sampled_squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int kSteps = 60;
  double least = 1e300;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const Vec3 q = a + (b - a) * (double(i) / kSteps) + (c - a) * (double(j) / kSteps);
      least = std::min(least, dot(p - q, p - q));
    }
  }
  return least;
}

TEST(PointTriangle, AgreesWithSamples) {
  std::mt19937 random(3);
  const auto point = [&] {
    const auto coordinate = [&] { return double(random() % 1000) / 500 - 1; };
    const double x = coordinate(), y = coordinate();
    return Vec3{x, y, coordinate()};
  };
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = point(), b = point(), c = point(), p = point() * 2;
    const double exact = PreparedTriangle(a, b, c).squared_distance(p);
    const double sampled = sampled_squared_distance(p, a, b, c);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_NEAR(std::sqrt(exact), std::sqrt(sampled), 0.07);
  }
}

TEST(PointTriangle, MeasuresDegenerateTriangles) {
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, m{1, 0, 0};
  EXPECT_DOUBLE_EQ(PreparedTriangle(a, b, b).squared_distance({1, 3, 0}), 9);
  EXPECT_DOUBLE_EQ(PreparedTriangle(a, a, b).squared_distance({1, 3, 0}), 9);
  EXPECT_DOUBLE_EQ(PreparedTriangle(a, m, b).squared_distance({1, 3, 0}), 9);
  EXPECT_DOUBLE_EQ(PreparedTriangle(a, a, a).squared_distance({0, 3, 4}), 25);
}

}  // namespace
}  // namespace selvage
