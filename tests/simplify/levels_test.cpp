// SPDX-License-Identifier: MIT
#include "server/simplify/levels.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "common/mesh/boundary_loops.h"
#include "common/mesh/grid.h"
#include "server/segment/check_partition.h"
#include "server/segment/regularise.h"
#include "tests/simplify/simplify_support.h"
#include "tests/support/labelled_shapes.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

struct LabelledMesh {
  std::string name;
  CornerTable table;
  std::vector<Vec3> positions;
  Segmentation segmentation;
};

/// Patches: cubes of side `cell` hold the vertices of a label, made codable.
LabelledMesh labelled(std::string name, CornerTable table, std::vector<Vec3> positions, double cell) {
  std::vector<std::uint32_t> labels;
  for (const Vec3& p : positions) {
    const auto step = [&](double x) { return static_cast<std::uint32_t>(std::floor(x / cell) + 512); };
    labels.push_back(step(p.x) << 20 | step(p.y) << 10 | step(p.z));
  }
  Segmentation segmentation = regularise(table, labels, {.min_piece_triangles = 3}, positions);
  return {std::move(name), std::move(table), std::move(positions), std::move(segmentation)};
}

LabelledMesh labelled(std::string name, const TriangleSoup& soup, double cell) {
  return labelled(std::move(name), build_corner_table(soup.triangles, std::uint32_t(soup.positions.size())),
                  soup.positions, cell);
}

std::vector<LabelledMesh> models() {
  std::vector<LabelledMesh> all;
  for (const LabelledShape& shape : labelled_shapes())
    all.push_back(labelled(shape.name, shape.soup, shape.cell));
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    RandomManifold mesh = random_manifold(seed);
    all.push_back(labelled("random " + std::to_string(seed), mesh.table, mesh.positions, 1.5));
  }
  return all;
}

LevelledMesh levels_of(const LabelledMesh& mesh, Simplification* run = nullptr) {
  std::vector<LevelTarget> targets;
  for (const double ratio : {0.5, 0.25, 0.125, 0.0625, 0.0}) {
    targets.push_back({static_cast<std::uint32_t>(ratio * mesh.table.triangle_count())});
  }
  const auto& labels = mesh.segmentation.region_of_vertex;
  const Simplification simplification = simplify({mesh.table, mesh.positions, labels}, targets);
  if (run != nullptr) *run = simplification;
  return split_by_region(mesh.table, labels, mesh.segmentation.region_count, simplification);
}

std::vector<Triangle> mix(const LabelledMesh& mesh, const LevelledMesh& levels,
                          std::span<const std::uint32_t> level_of_region) {
  return mixed_triangles(mesh.table, mesh.segmentation.region_of_vertex, levels, level_of_region);
}

TEST(Levels, AnyMixIsAManifoldWithTheBordersOfTheInput) {
  std::mt19937 random(1);
  for (const LabelledMesh& mesh : models()) {
    const LevelledMesh levels = levels_of(mesh);
    const std::uint32_t vertices = mesh.table.vertex_count();
    const std::vector<std::uint32_t> finest(mesh.segmentation.region_count + 1, 0);
    const Topology expected = topology_of(mix(mesh, levels, finest), vertices);
    for (int round = 0; round < 24; ++round) {
      std::vector<std::uint32_t> level_of_region = finest;
      for (std::uint32_t& level : level_of_region) {
        // At first the extremes, where lockstep tests would not tell.
        level = round < 8 ? 5 * (random() % 2) : random() % 6;
      }
      const std::vector<Triangle> mixed = mix(mesh, levels, level_of_region);
      ASSERT_EQ(manifold_violation(mixed, vertices), "") << mesh.name << ", round " << round;
      ASSERT_EQ(topology_of(mixed, vertices), expected) << mesh.name << ", round " << round;
    }
  }
}

/// A flat sheet of two regions, their border a wave.
LabelledMesh wave() {
  const TriangleSoup soup = shapes::grid(40, 40);
  std::vector<std::uint32_t> labels;
  for (const Vec3& p : soup.positions) labels.push_back(p.y > 20 + 8 * std::sin(p.x / 3));
  LabelledMesh mesh{
      "wave", build_corner_table(soup.triangles, std::uint32_t(soup.positions.size())), soup.positions, {}};
  mesh.segmentation = regularise(mesh.table, labels, {}, mesh.positions);
  EXPECT_EQ(mesh.segmentation.region_count, 2u);
  return mesh;
}

Vec3 normal_of(const LabelledMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.positions[t[0]];
  return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

// Two loops that turn together can both be cut short without a trace; against the other one left fine, the
// cut lies across its bends.
TEST(Levels, ThatDifferByOneFoldNoFlatMesh) {
  const LabelledMesh mesh = wave();
  const LevelledMesh levels = levels_of(mesh);
  const auto count = static_cast<std::uint32_t>(levels.regions.size());
  for (std::uint32_t one = 0; one < count; ++one) {
    for (std::uint32_t other = one > 0 ? one - 1 : 0; other < std::min(one + 2, count); ++other) {
      for (const Triangle& t : mix(mesh, levels, std::vector<std::uint32_t>{0, one, other}))
        ASSERT_GT(normal_of(mesh, t).z, 0) << "levels " << one << " and " << other;
    }
  }
}

// Farther apart they may, in few small triangles.
TEST(Levels, FoldLittleOfAFlatMeshInAnyMix) {
  const LabelledMesh mesh = wave();
  const LevelledMesh levels = levels_of(mesh);
  const auto count = static_cast<std::uint32_t>(levels.regions.size());
  double most = 0;
  for (std::uint32_t one = 0; one < count; ++one) {
    for (std::uint32_t other = 0; other < count; ++other) {
      double all = 0, folded = 0;
      for (const Triangle& t : mix(mesh, levels, std::vector<std::uint32_t>{0, one, other})) {
        const double z = normal_of(mesh, t).z;
        all += std::abs(z), folded += std::max(-z, 0.0);
      }
      most = std::max(most, folded / all);
    }
  }
  EXPECT_LT(most, 0.03);
}

TEST(Levels, OneRegionAloneAtEveryLevelIsValid) {
  const LabelledMesh mesh = labelled("torus", shapes::torus(30, 90), 1.1);
  const LevelledMesh levels = levels_of(mesh);
  for (std::uint32_t other : {0u, 5u}) {
    for (RegionId region = 1; region <= mesh.segmentation.region_count; ++region) {
      for (std::uint32_t level = 0; level < 6; ++level) {
        std::vector<std::uint32_t> level_of_region(mesh.segmentation.region_count + 1, other);
        level_of_region[region] = level;
        ASSERT_EQ(manifold_violation(mix(mesh, levels, level_of_region), mesh.table.vertex_count()), "");
      }
    }
  }
}

TEST(Levels, TheFinestIsExact) {
  for (const LabelledMesh& mesh : models()) {
    const LevelledMesh levels = levels_of(mesh);
    const std::vector<std::uint32_t> finest(mesh.segmentation.region_count + 1, 0);
    std::vector<Triangle> expected;
    for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) expected.push_back(mesh.table.triangle(t));
    EXPECT_EQ(mix(mesh, levels, finest), expected) << mesh.name;
  }
}

TEST(Levels, VerticesListedAreThoseOfTheTriangles) {
  const LabelledMesh mesh = labelled("sphere", shapes::sphere(5), 0.4);
  const LevelledMesh levels = levels_of(mesh);
  for (std::size_t level = 0; level < levels.regions.size(); ++level) {
    for (RegionId region = 1; region <= mesh.segmentation.region_count; ++region) {
      std::set<VertexId> used;
      for (const TriangleId t : levels.regions[level][region].triangles) {
        for (const VertexId v : mesh.table.triangle(t))
          used.insert(levels.representative_of_vertex[level][v]);
      }
      EXPECT_EQ(std::vector<VertexId>(used.begin(), used.end()), levels.regions[level][region].vertices);
    }
  }
}

TEST(Levels, RepresentativesStayInTheirRegionAndLoopVerticesOnTheirLoop) {
  for (const LabelledMesh& mesh : models()) {
    const LevelledMesh levels = levels_of(mesh);
    const auto& labels = mesh.segmentation.region_of_vertex;
    std::vector<bool> is_loop_vertex(mesh.table.vertex_count(), false);
    for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
      const auto [a, b, c] = mesh.table.triangle(t);
      if (labels[a] == labels[b] && labels[a] == labels[c]) continue;
      is_loop_vertex[a] = is_loop_vertex[b] = is_loop_vertex[c] = true;
    }
    for (const auto& representative : levels.representative_of_vertex) {
      for (VertexId v = 0; v < mesh.table.vertex_count(); ++v) {
        ASSERT_EQ(labels[representative[v]], labels[v]);
        ASSERT_TRUE(!is_loop_vertex[v] || is_loop_vertex[representative[v]]);
      }
    }
  }
}

/// The region's own triangles at a level.
std::vector<Triangle> region_triangles(const LabelledMesh& mesh, const LevelledMesh& levels,
                                       std::size_t level, RegionId region) {
  std::vector<Triangle> triangles;
  for (const TriangleId t : levels.regions[level][region].triangles) {
    triangles.push_back(mesh.table.triangle(t));
    for (VertexId& v : triangles.back()) v = levels.representative_of_vertex[level][v];
  }
  return triangles;
}

/// Its loops, each from its lowest vertex, in order.
std::vector<std::vector<VertexId>> loops_of(const std::vector<Triangle>& triangles,
                                            std::uint32_t vertex_count) {
  const BoundaryLoops found = find_boundary_loops(build_corner_table(triangles, vertex_count));
  std::vector<std::vector<VertexId>> loops;
  auto at = found.vertices.begin();
  for (const std::uint32_t length : found.lengths) {
    loops.emplace_back(at, at + length);
    at += length;
  }
  return loops;
}

TEST(Levels, ARegionsOwnTrianglesStayOnePieceAtEveryLevel) {
  for (const LabelledMesh& mesh : models()) {
    const LevelledMesh levels = levels_of(mesh);
    const std::uint32_t count = mesh.table.vertex_count();
    for (RegionId region = 1; region <= mesh.segmentation.region_count; ++region) {
      const Topology finest = topology_of(region_triangles(mesh, levels, 0, region), count);
      for (std::size_t level = 1; level < levels.regions.size(); ++level) {
        const std::vector<Triangle> coarse = region_triangles(mesh, levels, level, region);
        ASSERT_EQ(manifold_violation(coarse, count), "") << mesh.name << " region " << region;
        ASSERT_EQ(topology_of(coarse, count), finest)
            << mesh.name << " region " << region << " level " << level;
      }
    }
  }
}

// What lets a level's map of the boundary be one bit for each vertex that went.
TEST(Levels, LoopsAreTheFinestOnesWithVerticesLeftOutAndThoseWentToTheNextOneKept) {
  for (const LabelledMesh& mesh : models()) {
    const LevelledMesh levels = levels_of(mesh);
    const std::uint32_t count = mesh.table.vertex_count();
    for (std::size_t level = 1; level < levels.regions.size(); ++level) {
      const auto& representative = levels.representative_of_vertex[level];
      for (RegionId region = 1; region <= mesh.segmentation.region_count; ++region) {
        std::vector<std::vector<VertexId>> expected;
        for (const auto& loop : loops_of(region_triangles(mesh, levels, 0, region), count)) {
          std::vector<VertexId> kept;
          for (const VertexId v : loop) {
            if (representative[v] == v) kept.push_back(v);
          }
          ASSERT_GE(kept.size(), 3u);
          for (std::size_t i = 0, next_kept = 0; i < loop.size(); ++i) {
            if (representative[loop[i]] == loop[i]) {
              ++next_kept;
              continue;
            }
            const VertexId previous = kept[(next_kept + kept.size() - 1) % kept.size()];
            const VertexId following = kept[next_kept % kept.size()];
            ASSERT_TRUE(representative[loop[i]] == previous || representative[loop[i]] == following);
          }
          std::rotate(kept.begin(), std::min_element(kept.begin(), kept.end()), kept.end());
          expected.push_back(kept);
        }
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(loops_of(region_triangles(mesh, levels, level, region), count), expected)
            << mesh.name << " region " << region << " level " << level;
      }
    }
  }
}

TEST(Levels, ARegionThatCannotShrinkRepeatsItsLevel) {
  const LabelledMesh mesh = labelled("sphere", shapes::sphere(4), 0.4);
  const std::vector<LevelTarget> targets = {{0}, {0}};
  const auto& labels = mesh.segmentation.region_of_vertex;
  const LevelledMesh levels = split_by_region(mesh.table, labels, mesh.segmentation.region_count,
                                              simplify({mesh.table, mesh.positions, labels}, targets));
  for (RegionId region = 1; region <= mesh.segmentation.region_count; ++region) {
    EXPECT_TRUE(levels.regions[2][region].is_repeat);
    EXPECT_EQ(levels.regions[2][region].triangles, levels.regions[1][region].triangles);
  }
}

// Quantised positions in, grid points out: a level's vertices are the finest mesh's.
TEST(Levels, WorkOnGridCoordinates) {
  const TriangleSoup soup = shapes::torus(30, 90);
  const Grid grid = make_grid(soup.positions, 10);
  std::vector<Vec3> positions;
  for (const Vec3& p : soup.positions) {
    const GridPoint g = grid.quantise(p);
    positions.push_back({double(g.x), double(g.y), double(g.z)});
  }
  LabelledMesh mesh = labelled("torus", soup, 3);
  mesh.positions = positions;
  Simplification run;
  const LevelledMesh levels = levels_of(mesh, &run);
  EXPECT_LT(run.levels[3].triangles, 700u);
  double largest = 0;
  for (const RegionLevel& region : levels.regions[3]) largest = std::max(largest, region.deviation);
  EXPECT_EQ(largest, run.levels[3].deviation);
}

}  // namespace
}  // namespace selvage
