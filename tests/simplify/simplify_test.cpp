// SPDX-License-Identifier: MIT
#include "server/simplify/simplify.h"

#include <gtest/gtest.h>

#include "common/mesh/check_corner_table.h"
#include "common/samples/samples.h"
#include "server/simplify/collapse_mesh.h"
#include "server/simplify/legality.h"
#include "server/simplify/levels.h"
#include "tests/simplify/simplify_support.h"
#include "tests/support/lathe.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr CollapseCost kCosts[] = {CollapseCost::PlaneDistance, CollapseCost::EdgeArea,
                                   CollapseCost::Quadric};

RandomManifold manifold_of(const TriangleSoup& soup) {
  return {build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size())),
          soup.positions};
}

std::vector<Triangle> level_of(const RandomManifold& mesh, const Simplification& run, std::size_t level) {
  return substituted_triangles(mesh.table, representatives_after(run.collapses, run.levels[level].collapses,
                                                                 mesh.table.vertex_count()));
}

Simplification simplify_to(const RandomManifold& mesh, LevelTarget target, SimplifyOptions options = {}) {
  return simplify({mesh.table, mesh.positions}, {&target, 1}, options);
}

/// Replays the run and checks the table after each collapse.
void expect_valid_at_every_step(const RandomManifold& mesh, const Simplification& run) {
  CollapseMesh replayed(mesh.table);
  Star star;
  for (const Collapse& collapse : run.collapses) {
    star.gather(replayed.table(), mesh.positions, collapse.from);
    const std::uint32_t place = star.place_of(collapse.to);
    ASSERT_NE(place, kNone) << "from " << collapse.from << " to " << collapse.to << ", which is no neighbour";
    replayed.collapse(star, place);
    const auto ok = check_corner_table(without_removed(replayed.table()));
    ASSERT_TRUE(ok) << ok.error().message << " after " << collapse.from << " to " << collapse.to;
  }
  EXPECT_EQ(replayed.triangle_count(), run.levels.back().triangles);
}

TEST(Simplify, KeepsTheTableValidAfterEveryCollapse) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const RandomManifold mesh = random_manifold(seed);
    for (const CollapseCost cost : kCosts) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", cost " + std::to_string(int(cost)));
      expect_valid_at_every_step(mesh, simplify_to(mesh, {.triangles = 0}, {.cost = cost}));
    }
  }
}

TEST(Simplify, KeepsTopologyByIndicesAlone) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const RandomManifold mesh = random_manifold(seed);
    const Simplification run = simplify_to(mesh, {.triangles = 0});
    const std::uint32_t count = mesh.table.vertex_count();
    EXPECT_EQ(manifold_violation(level_of(mesh, run, 1), count), "") << "seed " << seed;
    EXPECT_EQ(topology_of(level_of(mesh, run, 1), count), topology_of(level_of(mesh, run, 0), count))
        << "seed " << seed;
  }
}

TEST(Simplify, LeavesTheSimplestMeshesAlone) {
  for (const TriangleSoup& soup : {shapes::triangle(), shapes::tetrahedron(), shapes::pillow()}) {
    EXPECT_TRUE(simplify_to(manifold_of(soup), {.triangles = 0}).collapses.empty());
  }
}

TEST(Simplify, TakesASphereToATetrahedron) {
  const RandomManifold mesh = manifold_of(shapes::sphere(4));
  // Nothing can be flipped over on the way down when only convexity is asked.
  EXPECT_LE(simplify_to(mesh, {.triangles = 4}, {.flip = FlipTest::Concave}).levels[1].triangles, 8u);
}

TEST(Simplify, MeetsTriangleCounts) {
  const RandomManifold mesh = manifold_of(shapes::torus(40, 80));
  const std::vector<LevelTarget> targets = {{3200}, {1601}, {800}, {800}};
  const Simplification run = simplify({mesh.table, mesh.positions}, targets);
  ASSERT_EQ(run.levels.size(), 5u);
  EXPECT_EQ(run.levels[0].triangles, 6400u);
  EXPECT_EQ(run.levels[1].triangles, 3200u);
  EXPECT_EQ(run.levels[2].triangles, 1600u);
  EXPECT_EQ(run.levels[3].triangles, 800u);
  EXPECT_EQ(run.levels[4].collapses, run.levels[3].collapses);
  for (std::size_t level = 0; level < run.levels.size(); ++level) {
    EXPECT_EQ(level_of(mesh, run, level).size(), run.levels[level].triangles);
  }
}

TEST(Simplify, LevelsOfOneRunAreThoseOfRunsOfTheirOwn) {
  const RandomManifold mesh = manifold_of(shapes::torus(24, 60));
  const std::vector<LevelTarget> targets = {{1200}, {300}};
  const Simplification both = simplify({mesh.table, mesh.positions}, targets);
  EXPECT_EQ(level_of(mesh, both, 2), level_of(mesh, simplify_to(mesh, {300}), 1));
}

TEST(Simplify, KeepsTheAskedDeviation) {
  const RandomManifold mesh = manifold_of(shapes::sphere(5));
  for (const CollapseCost cost : kCosts) {
    const std::vector<LevelTarget> targets = {{0, 0.005}, {0, 0.05}};
    const Simplification run = simplify({mesh.table, mesh.positions}, targets, {.cost = cost});
    for (std::size_t level = 1; level < 3; ++level) {
      EXPECT_LE(run.levels[level].deviation, targets[level - 1].max_deviation);
      // Measured from the vertices that went, against any triangle, the distance is not more.
      EXPECT_LE(farthest_from(mesh.positions, level_of(mesh, run, level), mesh.positions),
                run.levels[level].deviation * (1 + 1e-9));
    }
    EXPECT_LT(run.levels[1].triangles, 8192u / 2);
    EXPECT_LT(run.levels[2].triangles, run.levels[1].triangles / 3);
  }
}

TEST(Simplify, DoesNotDependOnTheUnit) {
  const RandomManifold metres = manifold_of(make_sample("dumbbell", 4000).value());
  RandomManifold other = metres;
  for (Vec3& p : other.positions) p = p * 1024;  // a power of two: exact
  for (const CollapseCost cost : kCosts) {
    const Simplification a = simplify_to(metres, {400}, {.cost = cost});
    const Simplification b = simplify_to(other, {400}, {.cost = cost});
    EXPECT_EQ(level_of(metres, a, 1), level_of(other, b, 1)) << "cost " << int(cost);
  }
}

TEST(Simplify, IsDeterministic) {
  const RandomManifold mesh = random_manifold(7);
  const Simplification a = simplify_to(mesh, {0}), b = simplify_to(mesh, {0});
  EXPECT_EQ(level_of(mesh, a, 1), level_of(mesh, b, 1));
}

TEST(Simplify, LeavesPinnedVerticesWhereTheyAre) {
  const RandomManifold mesh = manifold_of(shapes::torus(20, 40));
  const std::vector<VertexId> pinned = {3, 77, 500};
  const LevelTarget target{0};
  const Simplification run = simplify({mesh.table, mesh.positions, {}, pinned}, {&target, 1});
  const auto count = static_cast<std::uint32_t>(run.collapses.size());
  const auto representative = representatives_after(run.collapses, count, mesh.table.vertex_count());
  EXPECT_GT(count, 700u);
  for (const VertexId v : pinned) EXPECT_EQ(representative[v], v);
}

// Dissertation Fig. 3.18: others drill holes into the handle and leave sheets in the box. EA keeps the handle
// connected, but not straight: along a sharp edge its E_C is largest, so vertices leave the edge sideways.
TEST(Simplify, KeepsTheHandleOfABox) {
  const RandomManifold mesh = manifold_of(box_with_handle());
  const auto count = mesh.table.vertex_count();
  for (const CollapseCost cost : kCosts) {
    const Simplification run = simplify_to(mesh, {mesh.table.triangle_count() / 30}, {.cost = cost});
    const std::vector<Triangle> coarse = level_of(mesh, run, 1);
    EXPECT_EQ(topology_of(coarse, count), topology_of(level_of(mesh, run, 0), count));
    if (cost == CollapseCost::EdgeArea) continue;
    EXPECT_LT(farthest_from(mesh.positions, coarse, mesh.positions), 1e-6)
        << "cost " << int(cost) << ", " << coarse.size() << " triangles";
  }
}

// Dissertation Fig. 3.17: others eat an open sheet from its border.
TEST(Simplify, KeepsTheBordersOfALampShade) {
  constexpr int kAround = 48;
  const RandomManifold mesh = manifold_of(lamp(kAround));
  const auto count = mesh.table.vertex_count();
  const Simplification run = simplify_to(mesh, {mesh.table.triangle_count() / 20});
  const std::vector<Triangle> coarse = level_of(mesh, run, 1);
  EXPECT_EQ(topology_of(coarse, count), topology_of(level_of(mesh, run, 0), count));
  // The border as thin triangles, to measure the distance from its first vertices.
  std::vector<Triangle> border;
  for (const auto& [a, b] : border_edges(coarse)) border.push_back({a, b, b});
  EXPECT_GE(border.size(), 12u);
  const std::vector<Vec3> wide_border(mesh.positions.end() - kAround, mesh.positions.end());
  EXPECT_LT(farthest_from(wide_border, border, mesh.positions), 0.1 * 5);
}

}  // namespace
}  // namespace selvage
