// SPDX-License-Identifier: MIT
#include "server/simplify/simplify_soup.h"

#include <gtest/gtest.h>

#include "tests/simplify/simplify_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(SimplifySoup, GivesTheFileBackAtFullResolution) {
  TriangleSoup soup = shapes::torus(20, 30);
  std::swap(soup.triangles[17][1], soup.triangles[17][2]);  // turned by repair, and back
  const SimplifiedSoup result = simplify_soup(soup, {1200}).value();
  EXPECT_EQ(result.soup.triangles, soup.triangles);
  EXPECT_EQ(result.soup.positions, soup.positions);
  EXPECT_EQ(result.deviation, 0);
}

TEST(SimplifySoup, DropsWhatNoTriangleUses) {
  TriangleSoup soup = shapes::grid(4, 4);
  soup.positions.insert(soup.positions.begin(), Vec3{9, 9, 9});
  for (Triangle& t : soup.triangles)
    for (VertexId& v : t) ++v;
  soup.triangles.push_back({1, 1, 2});
  const SimplifiedSoup result = simplify_soup(soup, {32}).value();
  EXPECT_EQ(result.soup.triangles.size(), 32u);
  EXPECT_EQ(result.soup.positions.size(), 25u);
}

TEST(SimplifySoup, LeavesNonManifoldPlacesWhereTheyAre) {
  // Two balls that share a vertex.
  TriangleSoup soup = shapes::sphere(4);
  TriangleSoup other = shapes::translated(shapes::sphere(4), {2, 0, 0});
  const auto count = static_cast<VertexId>(soup.positions.size());
  shapes::append(soup, other);
  for (Triangle& t : soup.triangles)
    for (VertexId& v : t) v = v == count + 1 ? 0 : v;  // 0 is at +x of the first, 1 at -x of the second
  const SimplifiedSoup result = simplify_soup(soup, {200}).value();
  EXPECT_EQ(result.pinned_vertices, 2u);
  EXPECT_EQ(result.soup.triangles.size(), 200u);
  EXPECT_EQ(result.soup.positions[0], (Vec3{1, 0, 0}));
  EXPECT_TRUE(border_edges(result.soup.triangles).empty());
}

TEST(SimplifySoup, RefusesWhatRepairRefuses) { EXPECT_FALSE(simplify_soup({}, {10})); }

}  // namespace
}  // namespace selvage
