// SPDX-License-Identifier: MIT
#include "common/render/palette.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace selvage {
namespace {

int difference(Rgb a, Rgb b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

TEST(Palette, GivesTheFirstRegionsColoursFarApart) {
  for (RegionId a = 0; a < 12; ++a)
    for (RegionId b = 0; b < a; ++b)
      EXPECT_GT(difference(colour_of_region(a), colour_of_region(b)), 30) << a << " " << b;
}

TEST(Palette, TellsNeighboursApartInAnyMap) {
  std::vector<RegionPair>
      ring_of_far_numbers;  // every region beside the eight before it at golden-section strides
  for (RegionId r = 1; r < 400; ++r)
    for (RegionId step : {1u, 3u, 8u, 21u, 34u, 55u, 89u, 144u})
      if (r > step) ring_of_far_numbers.push_back({r - step, r});
  const auto colours = colours_of_regions(400, ring_of_far_numbers);
  for (const auto& [a, b] : ring_of_far_numbers)
    EXPECT_GT(difference(colours[a], colours[b]), 30) << a << " " << b;
}

TEST(Palette, KeepsTheUsualColourWhereNoNeighbourObjects) {
  const auto colours = colours_of_regions(30, {});
  for (RegionId r = 0; r < 30; ++r) EXPECT_EQ(colours[r], colour_of_region(r));
}

TEST(Palette, FindsNeighboursAcrossBoundaryTriangles) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 2, 3}, {3, 4, 5}};
  const std::vector<RegionId> region_of_vertex = {1, 1, 1, 4, 2, 3};
  EXPECT_EQ(neighbouring_regions(triangles, region_of_vertex),
            (std::vector<RegionPair>{{1, 4}, {2, 3}, {2, 4}, {3, 4}}));
}

TEST(Palette, PaintsBoundaryTrianglesInTheirOwnColour) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 2, 3}};
  const std::vector<RegionId> region_of_vertex = {1, 1, 1, 2};
  const std::vector<Rgb> colours = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  const RegionPaint paint = paint_regions(triangles, region_of_vertex, colours, {9, 9, 9});
  EXPECT_EQ(paint.colour_of_triangle, (std::vector<Rgb>{{2, 2, 2}, {9, 9, 9}}));
  EXPECT_EQ(paint.region_of_triangle, (std::vector<RegionId>{1, kNone}));
}

}  // namespace
}  // namespace selvage
