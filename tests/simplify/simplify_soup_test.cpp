// SPDX-License-Identifier: MIT
#include "server/simplify/simplify_soup.h"

#include <gtest/gtest.h>

#include "tests/ingest/restored.h"
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

TEST(SimplifySoup, TakesAnyTriangles) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const TriangleSoup soup = random_soup(seed);
    const auto result = simplify_soup(soup, {0});
    if (!result) continue;  // no triangle without a repeated index
    for (const Triangle& t : result->soup.triangles) {
      for (const VertexId v : t) ASSERT_LT(v, result->soup.positions.size());
      ASSERT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    // The positions are the file's, in its order.
    std::size_t at = 0;
    for (const Vec3& p : soup.positions)
      at += at < result->soup.positions.size() && result->soup.positions[at] == p;
    EXPECT_EQ(at, result->soup.positions.size()) << "seed " << seed;
  }
}

TEST(SimplifySoup, StopsWhenTold) {
  const auto stopped = simplify_soup(shapes::sphere(5), {100}, {}, [](double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

TEST(SimplifySoup, RefusesWhatRepairRefuses) { EXPECT_FALSE(simplify_soup({}, {10})); }

}  // namespace
}  // namespace selvage
