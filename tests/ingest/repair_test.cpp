// SPDX-License-Identifier: MIT
#include "server/ingest/repair.h"

#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "tests/ingest/restored.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A soup whose positions do not matter: vertex i at a place of its own.
TriangleSoup soup_of(std::vector<Triangle> triangles, std::uint32_t vertex_count) {
  TriangleSoup soup;
  for (std::uint32_t v = 0; v < vertex_count; ++v)
    soup.positions.push_back({double(v), double(v * v), double(v % 3)});
  soup.triangles = std::move(triangles);
  return soup;
}

/// Repairs, and checks what must hold whatever the input.
RepairedMesh repaired(const TriangleSoup& soup) {
  auto mesh = repair(soup);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh) return {};
  expect_lossless(*mesh, soup);
  return std::move(*mesh);
}

void turn(Triangle& triangle) { std::swap(triangle[0], triangle[2]); }

TEST(Repair, LeavesACleanMeshAlone) {
  TriangleSoup soup = shapes::chain_of_tori(1);
  shapes::append(soup, shapes::open_cylinder(6, 2));
  const RepairReport report = repaired(soup).report;
  EXPECT_EQ(report.dropped_triangles, 0u);
  EXPECT_EQ(report.unreferenced_vertices, 0u);
  EXPECT_EQ(report.duplicate_triangles, 0u);
  EXPECT_EQ(report.zero_area_triangles, 0u);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  EXPECT_EQ(report.non_manifold_vertices, 0u);
  EXPECT_EQ(report.vertex_copies, 0u);
  EXPECT_EQ(report.turned_triangles, 0u);
  EXPECT_EQ(report.non_orientable_cuts, 0u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.boundary_edges, 12u);
}

TEST(Repair, DropsOnlyTrianglesThatRepeatAnIndex) {
  const auto mesh = repaired(soup_of({{0, 0, 1}, {0, 1, 2}, {2, 1, 2}, {1, 3, 2}, {4, 3, 4}}, 5));
  EXPECT_EQ(mesh.report.dropped_triangles, 3u);
  EXPECT_EQ(mesh.source_of_triangle, (std::vector<TriangleId>{1, 3}));
  EXPECT_EQ(mesh.report.unreferenced_vertices, 1u) << "vertex 4 was used by a dropped triangle only";
}

TEST(Repair, SaysSoWhenNothingIsLeft) {
  const auto nothing = repair(soup_of({{0, 0, 1}, {2, 2, 2}}, 3));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::BadFile);
  EXPECT_EQ(nothing.error().message, "no triangle left after dropping 2 with repeated indices");
  EXPECT_FALSE(repair(TriangleSoup{}));
}

TEST(Repair, DropsUnreferencedVertices) {
  const auto mesh = repaired(soup_of({{4, 1, 6}}, 8));
  EXPECT_EQ(mesh.report.unreferenced_vertices, 5u);
  EXPECT_EQ(mesh.source_of_vertex, (std::vector<VertexId>{4, 1, 6}));
}

TEST(Repair, KeepsZeroAreaTriangles) {
  TriangleSoup soup = shapes::grid(3, 3);
  soup.positions[5] = soup.positions[6];
  const auto mesh = repaired(soup);
  EXPECT_EQ(mesh.report.zero_area_triangles, 2u);
  EXPECT_EQ(mesh.table.triangle_count(), 18u);
}

TEST(Repair, KeepsAnIsolatedTriangle) {
  const auto mesh = repaired(shapes::triangle());
  EXPECT_EQ(mesh.report.boundary_edges, 3u);
  EXPECT_EQ(mesh.table.vertex_count(), 3u);
}

TEST(Repair, SplitsABowTie) {
  const auto mesh = repaired(soup_of({{0, 1, 2}, {0, 3, 4}}, 5));
  EXPECT_EQ(mesh.report.non_manifold_vertices, 1u);
  EXPECT_EQ(mesh.report.vertex_copies, 1u);
  EXPECT_EQ(mesh.source_of_vertex, (std::vector<VertexId>{0, 1, 2, 0, 3, 4}));
}

TEST(Repair, SplitsTwoClosedFansAtOneVertex) {  // two tetrahedra, tip to tip
  TriangleSoup soup = shapes::tetrahedron();
  for (Triangle t : shapes::tetrahedron().triangles) {
    for (std::uint32_t& v : t) v = v == 3 ? 3 : v + 4;
    soup.triangles.push_back(t);
  }
  for (int i = 0; i < 3; ++i) soup.positions.push_back({double(i), 5, 5});
  soup.positions.push_back({});
  const auto mesh = repaired(soup);
  EXPECT_EQ(mesh.report.vertex_copies, 1u);
  EXPECT_EQ(mesh.report.boundary_edges, 0u);
  EXPECT_EQ(mesh.report.components, 2u);
}

TEST(Repair, PairsTwoOfThreeTrianglesOnAnEdge) {
  const auto mesh = repaired(soup_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5));
  EXPECT_EQ(mesh.report.non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report.components, 2u);
  EXPECT_EQ(mesh.report.vertex_copies, 2u);
  EXPECT_EQ(mesh.report.turned_triangles, 0u);
}

TEST(Repair, PairsFourTrianglesOnAnEdge) {
  const auto mesh = repaired(soup_of({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {1, 0, 5}}, 6));
  EXPECT_EQ(mesh.report.non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report.components, 2u);
  EXPECT_EQ(mesh.report.boundary_edges, 8u);
}

TEST(Repair, LeavesAnEdgeOpenWhereAllTrianglesRunTheSameWay) {
  const auto mesh = repaired(soup_of({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, 5));
  EXPECT_EQ(mesh.report.components, 3u);
  EXPECT_EQ(mesh.report.turned_triangles, 0u);
}

TEST(Repair, PairsAcrossPiecesSoThatNothingIsSplit) {  // two tetrahedra that share an edge
  TriangleSoup soup = shapes::tetrahedron();
  for (Triangle t : shapes::tetrahedron().triangles) {
    for (std::uint32_t& v : t) v = v < 2 ? v : v + 2;
    soup.triangles.push_back(t);
  }
  soup.positions.resize(6);
  const auto mesh = repaired(soup);
  EXPECT_EQ(mesh.report.non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report.boundary_edges, 0u);
  EXPECT_EQ(mesh.report.components, 1u);
  EXPECT_EQ(mesh.report.vertex_copies, 0u);
}

TEST(Repair, TakesABookOfManyPages) {  // one edge with 50000 triangles
  std::vector<Triangle> pages;
  for (std::uint32_t v = 2; v < 50002; ++v) pages.push_back(v % 2 ? Triangle{0, 1, v} : Triangle{v, 1, 0});
  const auto mesh = repaired(soup_of(std::move(pages), 50002));
  EXPECT_EQ(mesh.report.non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report.components, 25000u);
}

TEST(Repair, TurnsTheFewerTriangles) {
  TriangleSoup soup = shapes::sphere(2);
  for (std::size_t t : {3, 17, 18, 40}) turn(soup.triangles[t]);
  EXPECT_EQ(repaired(soup).report.turned_triangles, 4u);
  for (Triangle& t : soup.triangles) turn(t);
  const auto mesh = repaired(soup);
  EXPECT_EQ(mesh.report.turned_triangles, 4u);
  EXPECT_TRUE(mesh.is_turned[17]);
  EXPECT_EQ(mesh.report.non_orientable_cuts, 0u);
  EXPECT_EQ(mesh.report.components, 1u);
}

TEST(Repair, KeepsTheFirstTriangleOnATie) {
  const auto mesh = repaired(soup_of({{0, 1, 2}, {0, 1, 3}}, 4));
  EXPECT_EQ(mesh.is_turned, (std::vector<bool>{false, true}));
}

TEST(Repair, TurnsPiecesIndependently) {
  TriangleSoup soup = shapes::tetrahedron();
  shapes::append(soup, shapes::sphere(1));
  for (std::size_t t = 0; t < 4 + 5; ++t) turn(soup.triangles[t]);
  EXPECT_EQ(repaired(soup).report.turned_triangles, 5u) << "the tetrahedron stays inside out, as a whole";
}

TEST(Repair, UndoesAShuffledOrientation) {
  TriangleSoup soup = shapes::torus(8, 12);
  std::mt19937 random(7);
  for (Triangle& t : soup.triangles)
    if (random() % 2) turn(t);
  const auto mesh = repaired(soup);
  EXPECT_EQ(mesh.report.components, 1u);
  EXPECT_EQ(mesh.report.boundary_edges, 0u);
}

TEST(Repair, CutsAMobiusStripOnceWhereItsFileFlips) {
  const auto mesh = repaired(shapes::mobius_strip(40));
  EXPECT_EQ(mesh.report.non_orientable_cuts, 1u);
  EXPECT_EQ(mesh.report.turned_triangles, 0u);
  EXPECT_EQ(mesh.report.components, 1u);
  EXPECT_EQ(mesh.report.vertex_copies, 2u);
}

TriangleSoup klein_bottle(std::uint32_t around, std::uint32_t along) {  // a torus glued with a reflection
  std::vector<Triangle> triangles;
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i < along ? i * around + j % around : (around - j % around) % around;
  };
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return soup_of(std::move(triangles), around * along);
}

TEST(Repair, CutsAKleinBottleIntoATubeAtMost) {
  const auto mesh = repaired(klein_bottle(8, 20));
  EXPECT_EQ(mesh.report.non_orientable_cuts, 8u);
  EXPECT_EQ(mesh.report.turned_triangles, 0u);
  EXPECT_EQ(mesh.report.components, 1u);
  EXPECT_EQ(mesh.report.vertex_copies, 8u);
}

TEST(Repair, CutsAShuffledKleinBottleAlongFewEdges) {
  TriangleSoup soup = klein_bottle(30, 100);
  std::mt19937 random(3);
  for (Triangle& t : soup.triangles)
    if (random() % 2) turn(t);
  const auto mesh = repaired(soup);
  EXPECT_GE(mesh.report.non_orientable_cuts, 30u) << "its waist, the least possible";
  EXPECT_LE(mesh.report.non_orientable_cuts, 90u) << "of 9000 edges, half of which the file flips";
  EXPECT_EQ(mesh.report.components, 1u);
}

TEST(Repair, ClosesALoneDuplicateIntoAPillow) {
  for (const Triangle& duplicate : {Triangle{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {1, 0, 2}}) {
    const auto mesh = repaired(soup_of({{0, 1, 2}, duplicate}, 3));
    EXPECT_EQ(mesh.report.duplicate_triangles, 1u);
    EXPECT_EQ(mesh.report.boundary_edges, 0u);
    EXPECT_EQ(mesh.table.vertex_count(), 3u);
  }
}

TEST(Repair, SetsADuplicateInASurfaceApart) {
  for (bool is_opposite : {false, true}) {
    TriangleSoup soup = shapes::sphere(1);
    soup.triangles.push_back(soup.triangles[5]);
    soup.triangles.push_back(soup.triangles[5]);
    if (is_opposite) turn(soup.triangles.back());
    const auto mesh = repaired(soup);
    EXPECT_EQ(mesh.report.duplicate_triangles, 2u);
    EXPECT_EQ(mesh.report.non_manifold_edges, 3u);
  }
}

TEST(Repair, CountsDuplicatesOnlyWhenAllThreeVerticesAgree) {
  EXPECT_EQ(repaired(soup_of({{0, 1, 2}, {1, 0, 3}}, 4)).report.duplicate_triangles, 0u);
  EXPECT_EQ(repaired(soup_of({{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 1, 3}}, 4)).report.duplicate_triangles,
            2u);
}

TEST(Repair, IsLosslessOnRandomSoups) {
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleSoup soup = random_soup(seed);
    const auto mesh = repair(soup);
    if (mesh) expect_lossless(*mesh, soup);
    if (HasFailure()) break;
  }
}

TEST(Repair, GivesTheSameTwice) {
  const TriangleSoup soup = random_soup(3);
  const auto once = repaired(soup), again = repaired(soup);
  EXPECT_EQ(once.table.vertex_of_corner, again.table.vertex_of_corner);
  EXPECT_EQ(once.table.opposite, again.table.opposite);
  EXPECT_EQ(once.source_of_vertex, again.source_of_vertex);
}

}  // namespace
}  // namespace selvage
