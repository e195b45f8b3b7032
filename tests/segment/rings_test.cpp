// SPDX-License-Identifier: MIT
#include "server/segment/rings.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// The middle of a grid large enough that no ring reaches the border.
constexpr int kColumns = 20, kRows = 20;
constexpr VertexId kMiddle = 10 * (kColumns + 1) + 10;

TEST(Rings, OneRingIsTheNeighboursCounterClockwise) {
  const TestMesh mesh = mesh_of(shapes::grid(kColumns, kRows));
  RingWalker walker(mesh.table);
  const Ring ring = walker.walk(kMiddle, 1);
  ASSERT_TRUE(ring.is_closed);
  ASSERT_EQ(ring.vertices.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 a = mesh.positions[ring.vertices[i]] - mesh.positions[kMiddle];
    const Vec3 b = mesh.positions[ring.vertices[(i + 1) % 6]] - mesh.positions[kMiddle];
    EXPECT_GT(cross(a, b).z, 0);
  }
}

TEST(Rings, LevelLKeepsEveryLthOfTheVerticesAtDistanceL) {
  const TestMesh mesh = mesh_of(shapes::grid(kColumns, kRows));
  RingWalker walker(mesh.table);
  for (int level = 2; level <= 5; ++level) {
    const Ring ring = walker.walk(kMiddle, level);
    EXPECT_EQ(ring.vertices.size(), 6u) << "6 L vertices at distance L, one in L kept";
    for (VertexId v : ring.vertices) {
      // On this triangulation a step goes along x, y or the diagonal (1, 1).
      const int dx = int(v % (kColumns + 1)) - 10, dy = int(v / (kColumns + 1)) - 10;
      const int distance = dx * dy > 0 ? std::max(std::abs(dx), std::abs(dy)) : std::abs(dx) + std::abs(dy);
      EXPECT_EQ(distance, level);
    }
  }
}

TEST(Rings, BorderVertexGetsItsOpenOneRing) {
  const TestMesh mesh = mesh_of(shapes::grid(kColumns, kRows));
  RingWalker walker(mesh.table);
  const Ring ring = walker.walk(5, 4);
  EXPECT_FALSE(ring.is_closed);
  EXPECT_EQ(ring.vertices.size(), 4u);
}

TEST(Rings, FallsBackWhereThePatchHasNotOneBorder) {
  // Around a thin tube the ring of level 3 would be two loops.
  const TestMesh mesh = mesh_of(shapes::open_cylinder(5, 20));
  RingWalker walker(mesh.table);
  const Ring ring = walker.walk(5 * 10, 3);
  EXPECT_TRUE(ring.is_closed);
  EXPECT_GE(ring.vertices.size(), 4u);
}

TEST(Rings, ExistOnEveryOddMesh) {
  for (const auto& [name, mesh] : odd_meshes()) {
    SCOPED_TRACE(name);
    RingWalker walker(mesh.table);
    for (int level = 1; level <= 5; ++level) {
      for (VertexId v = 0; v < mesh.table.vertex_count(); ++v)
        EXPECT_GE(walker.walk(v, level).vertices.size(), 2u);
    }
  }
}

TEST(Rings, StaySmallBesideAVertexOfEnormousValence) {
  constexpr std::uint32_t kSpokes = 50000;
  TriangleSoup cone{{{0, 0, 1}}, {}};
  for (std::uint32_t i = 0; i < kSpokes; ++i)
    cone.positions.push_back({std::cos(i * 1e-4), std::sin(i * 1e-4), 0});
  cone.positions.push_back({0, 0, -1});
  for (std::uint32_t i = 0; i < kSpokes; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % kSpokes;
    cone.triangles.push_back({0, a, b});
    cone.triangles.push_back({kSpokes + 1, b, a});
  }
  const TestMesh mesh = mesh_of(cone);
  RingWalker walker(mesh.table);
  std::size_t total = 0;
  for (VertexId v = 1; v <= kSpokes; ++v) total += walker.walk(v, 5).vertices.size();
  EXPECT_EQ(total, 4u * kSpokes);  // quadratic would take minutes
}

}  // namespace
}  // namespace selvage
