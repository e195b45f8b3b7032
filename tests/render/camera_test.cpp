// SPDX-License-Identifier: MIT
#include "common/render/camera.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(Camera, ShowsAllPointsAndFillsThePicture) {
  const TriangleSoup torus = shapes::translated(shapes::torus(20, 40), {1000, -50, 3});
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const Camera camera =
        fit_camera(torus.positions, {.azimuth_degrees = 70, .projection = projection}, 400, 300, 0.1);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Vec3& p : torus.positions) {
      const Projected q = camera.project(p);
      left = std::min(left, q.x), right = std::max(right, q.x), top = std::min(top, q.y),
      bottom = std::max(bottom, q.y);
    }
    EXPECT_GE(left, 30 - 1e-6);
    EXPECT_LE(right, 370 + 1e-6);
    EXPECT_GE(top, 30 - 1e-6);
    EXPECT_LE(bottom, 270 + 1e-6);
    EXPECT_TRUE(std::abs(right - left - 340) < 1e-6 || std::abs(bottom - top - 240) < 1e-6);
  }
}

struct Axes {
  UpAxis up;
  Vec3 right, above, near;
};

TEST(Camera, LooksAtTheFrontWithXToTheRight) {
  for (const Axes& axes : {Axes{UpAxis::Y, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           Axes{UpAxis::Z, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}) {
    const TriangleSoup sphere = shapes::sphere(1);
    const Camera camera =
        fit_camera(sphere.positions, {.azimuth_degrees = 0, .elevation_degrees = 0, .up = axes.up}, 100, 100);
    const Projected middle = camera.project({}), right = camera.project(axes.right),
                    above = camera.project(axes.above);
    EXPECT_GT(right.x, middle.x + 10);
    EXPECT_NEAR(right.y, middle.y, 1e-9);
    EXPECT_LT(above.y, middle.y - 10);
    EXPECT_GT(camera.project(axes.near).nearness, middle.nearness);
  }
}

TEST(Camera, ShowsASinglePointInTheMiddle) {
  const std::vector<Vec3> point(3, Vec3{5, 6, 7});
  const Projected q = fit_camera(point, {}, 80, 60).project({5, 6, 7});
  EXPECT_EQ(q.x, 40);
  EXPECT_EQ(q.y, 30);
}

TEST(Camera, WorksWithoutPoints) {
  EXPECT_TRUE(std::isfinite(fit_camera({}, {}, 80, 60).project({1, 2, 3}).x));
}

}  // namespace
}  // namespace selvage
