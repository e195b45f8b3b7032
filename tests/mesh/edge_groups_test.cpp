// SPDX-License-Identifier: MIT
#include "common/mesh/edge_groups.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace selvage {
namespace {

std::vector<std::vector<CornerId>> sides_of(const EdgeGroups& edges) {
  std::vector<std::vector<CornerId>> sides;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    sides.emplace_back(edges[edge].begin(), edges[edge].end());
  }
  return sides;
}

TEST(EdgeGroups, NamesTheCornersThatFaceEachEdgeInOrderOfItsVertices) {
  const std::vector<Triangle> triangles = {{2, 1, 0}, {1, 2, 3}};  // edges 01, 02, 12, 13, 23
  EXPECT_EQ(sides_of(group_edges(triangles, 4)),
            (std::vector<std::vector<CornerId>>{{0}, {1}, {2, 5}, {4}, {3}}));
}

TEST(EdgeGroups, PutsAnyNumberOfTrianglesAtAnEdge) {
  const std::vector<Triangle> fan = {{0, 1, 2}, {1, 0, 3}, {4, 0, 1}, {1, 5, 0}};
  EXPECT_EQ(sides_of(group_edges(fan, 6))[0], (std::vector<CornerId>{2, 5, 6, 10}));
}

TEST(EdgeGroups, CountsTheEdgesOfAClosedMesh) {
  const TriangleSoup soup = shapes::sphere(3);
  const EdgeGroups edges = group_edges(soup.triangles, static_cast<std::uint32_t>(soup.positions.size()));
  EXPECT_EQ(edges.size(), soup.triangles.size() * 3 / 2);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) EXPECT_EQ(edges[edge].size(), 2u);
}

TEST(EdgeGroups, OfNothingAreNone) { EXPECT_EQ(group_edges({}, 0).size(), 0u); }

}  // namespace
}  // namespace selvage
