// SPDX-License-Identifier: MIT
#include "common/mesh/corner_table.h"

#include <gtest/gtest.h>

#include "common/mesh/boundary_loops.h"
#include "common/mesh/check_corner_table.h"
#include "common/mesh/grid.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

CornerTable table_of(const TriangleSoup& soup) {
  return build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size()));
}

int euler_characteristic(const CornerTable& table) {
  int edges = 0;
  for (CornerId c = 0; c < table.corner_count(); ++c) edges += table.opposite[c] == kNone || c < table.opposite[c];
  return static_cast<int>(table.vertex_count()) - edges + static_cast<int>(table.triangle_count());
}

struct Case {
  const char* name;
  TriangleSoup soup;
  int euler;
  std::vector<std::uint32_t> loops;
};

TEST(CornerTable, KnowsTheTopologyOfHandMadeShapes) {
  const std::vector<Case> cases = {
      {"triangle", shapes::triangle(), 1, {3}},
      {"tetrahedron", shapes::tetrahedron(), 2, {}},
      {"grid", shapes::grid(4, 3), 1, {14}},
      {"holes", shapes::grid_with_holes(8, 8, 2), -1, {32, 4, 4}},
      {"torus", shapes::torus(6, 9), 0, {}},
      {"sphere", shapes::sphere(2), 2, {}},
      {"cylinder", shapes::open_cylinder(7, 3), 0, {7, 7}},
      {"genus 3", shapes::chain_of_tori(2), -4, {}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const CornerTable table = table_of(c.soup);
    const auto ok = check_corner_table(table);
    EXPECT_TRUE(ok) << ok.error().message;
    EXPECT_EQ(euler_characteristic(table), c.euler);
    EXPECT_EQ(find_boundary_loops(table).lengths, c.loops);
  }
}

TEST(CornerTable, LoopsStartAtTheirLowestVertexAndFollowTriangleEdges) {
  const auto soup = shapes::grid(2, 1);
  EXPECT_EQ(find_boundary_loops(table_of(soup)).vertices, (std::vector<VertexId>{0, 1, 2, 5, 4, 3}));
}

TEST(CornerTable, LeavesNonManifoldEdgesOpen) {
  const std::vector<Triangle> three_on_an_edge = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const CornerTable table = build_corner_table(three_on_an_edge, 5);
  for (CornerId across : table.opposite) EXPECT_EQ(across, kNone);
  EXPECT_FALSE(check_corner_table(table));
}

TEST(CheckCornerTable, SeesABrokenTwin) {
  CornerTable table = table_of(shapes::sphere(1));
  std::swap(table.opposite[0], table.opposite[1]);
  EXPECT_FALSE(check_corner_table(table));
}

TEST(CheckCornerTable, SeesABowTie) {
  const CornerTable table = build_corner_table(std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}, 5);
  EXPECT_FALSE(check_corner_table(table));
}

TEST(Grid, RoundsToHalfAStepAndKeepsLargeOffsets) {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back({4.5e6 + 0.37 * i, -0.11 * i, 12.0});
  const Grid grid = make_grid(points, 12);
  for (const Vec3& p : points) {
    const Vec3 back = grid.position(grid.quantise(p));
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(back[axis] - p[axis]), grid.step * 0.5001);
  }
}

TEST(Grid, SurvivesPointsWithoutExtent) {
  const std::vector<Vec3> points(3, Vec3{1, 2, 3});
  const Grid grid = make_grid(points, 24);
  EXPECT_EQ(grid.position(grid.quantise(points[0])), points[0]);
}

}  // namespace
}  // namespace selvage
