// SPDX-License-Identifier: MIT
#include "common/render/rasterise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/render/labels.h"

namespace selvage {
namespace {

using Points = std::vector<Projected>;
using Triangles = std::vector<Triangle>;

TEST(Rasterise, CoversSamplesWhoseMiddleIsInside) {
  const auto seen = rasterise(Points{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, Triangles{{0, 1, 2}}, 4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(seen.at(x, y), x + y < 4 ? 0u : kNone) << x << " " << y;
}

TEST(Rasterise, ShowsBothSides) {
  const auto seen = rasterise(Points{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, Triangles{{0, 2, 1}}, 4, 4);
  EXPECT_EQ(seen.at(0, 0), 0u);
}

TEST(Rasterise, KeepsTheNearestWhateverTheOrder) {
  const Points points = {{-9, -9, 1}, {20, -9, 1}, {-9, 20, 1}, {-9, -9, 2}, {20, -9, 2}, {-9, 20, 2}};
  EXPECT_EQ(rasterise(points, Triangles{{0, 1, 2}, {3, 4, 5}}, 2, 2).at(0, 0), 1u);
  EXPECT_EQ(rasterise(points, Triangles{{3, 4, 5}, {0, 1, 2}}, 2, 2).at(0, 0), 0u);
}

TEST(Rasterise, InterpolatesNearness) {
  const Points crossing = {{0, 0, 0}, {10, 0, 10}, {0, 10, 0}, {10, 10, 10},
                           {0, 0, 5}, {10, 0, 5},  {0, 10, 5}, {10, 10, 5}};
  const auto seen = rasterise(crossing, Triangles{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}, {5, 7, 6}}, 10, 10);
  for (int x = 0; x < 10; ++x) EXPECT_EQ(seen.at(x, 4) >= 2, x < 5) << x;
}

TEST(Rasterise, LeavesNoGapsInAFan) {
  Points points = {{50, 50, 1}};
  Triangles triangles;
  for (std::uint32_t i = 0; i < 97; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 97;
    points.push_back({50 + 49 * std::cos(angle), 50 + 49 * std::sin(angle), 1});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % 97});
  }
  const auto seen = rasterise(points, triangles, 100, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x)
      EXPECT_TRUE(std::hypot(x + 0.5 - 50, y + 0.5 - 50) > 48 || seen.at(x, y) != kNone) << x << " " << y;
}

TEST(Rasterise, SkipsWhatHasNoAreaOrNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = 1e300;
  const Points points = {{1, 1, 1}, {3, 3, 1}, {5, 5, 1}, {nan, 1, 1}, {far, far, 1}, {-far, 3, 1}};
  const auto seen = rasterise(points, Triangles{{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {0, 2, 3}}, 6, 6);
  for (TriangleId t : seen.triangle) EXPECT_EQ(t, kNone);
  EXPECT_EQ(rasterise(points, Triangles{{0, 4, 5}}, 6, 6).triangle.size(), 36u);
}

TEST(Labels, StandInTheMiddleOfWhatIsSeen) {
  // Region 7 is a square of 40 with region 8, a smaller one, over its right half.
  const Points points = {{0, 0, 1},  {40, 0, 1}, {40, 40, 1}, {0, 40, 1},
                         {20, 0, 2}, {40, 0, 2}, {40, 40, 2}, {20, 40, 2}};
  const auto seen = rasterise(points, Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}, 40, 40);
  const std::vector<RegionId> region = {7, 7, 8, 8};
  const auto places = find_label_places(seen, region);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].region, 7u);
  EXPECT_NEAR(places[0].x, 10, 1);
  EXPECT_NEAR(places[0].room, 10, 1);
  EXPECT_NEAR(places[1].x, 30, 1);
}

TEST(Labels, AreNotGivenToHiddenOrNamelessTriangles) {
  const Points points = {{0, 0, 1}, {9, 0, 1}, {0, 9, 1}, {0, 0, 2}, {9, 0, 2}, {0, 9, 2}};
  const auto seen = rasterise(points, Triangles{{0, 1, 2}, {3, 4, 5}}, 10, 10);
  EXPECT_TRUE(find_label_places(seen, std::vector<RegionId>{1, kNone}).empty());
}

}  // namespace
}  // namespace selvage
