// SPDX-License-Identifier: MIT
#include "server/segment/regularise.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(Regularise, MakesRandomLabelsCodableOnEveryOddMesh) {
  for (const auto& [name, mesh] : odd_meshes()) {
    for (std::uint32_t label_count : {1u, 2u, 3u, 10u, 1000u}) {
      for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const auto labels = random_labels(mesh.table.vertex_count(), label_count, seed);
        for (std::uint32_t dust : {0u, 8u, 100u}) {
          const auto result = regularise(
              mesh.table, labels, {.min_component_vertices = dust, .min_piece_triangles = 4}, mesh.positions);
          ASSERT_EQ(violation_of(mesh.table, result), "")
              << name << ", labels " << label_count << ", seed " << seed;
        }
      }
    }
  }
}

/// Patches with ragged, self-touching borders: closer to what segmentation makes than independent labels.
std::vector<std::uint32_t> noisy_patches(const TestMesh& mesh, std::uint32_t label_count,
                                         std::uint32_t seed) {
  auto labels = random_labels(mesh.table.vertex_count(), label_count, seed);
  for (std::uint32_t round = 0; round < 4; ++round) {
    for (VertexId v = 0; v < mesh.table.vertex_count(); ++v) {
      labels[v] = labels[mesh.table.vertex(next(mesh.table.corner_of_vertex[v]))];
    }
  }
  return labels;
}

TEST(Regularise, MakesNoisyPatchesCodable) {
  for (const auto& [name, mesh] : odd_meshes()) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
      const auto labels = noisy_patches(mesh, 2 + seed % 9, seed);
      const auto result =
          regularise(mesh.table, labels, {.min_piece_triangles = 1 + seed % 70}, mesh.positions);
      ASSERT_EQ(violation_of(mesh.table, result), "") << name << ", seed " << seed;
    }
  }
}

TEST(Regularise, HoldsWithoutAnyDissolvingRound) {
  const TestMesh mesh = mesh_of(shapes::torus(16, 40));
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto result = regularise(mesh.table, random_labels(mesh.table.vertex_count(), 2, seed),
                                   {.max_rounds = 0}, mesh.positions);
    EXPECT_EQ(violation_of(mesh.table, result), "");
  }
}

TEST(Regularise, KeepsLabelsThatAreCodableAlready) {
  const TestMesh mesh = mesh_of(shapes::open_cylinder(12, 30));
  std::vector<std::uint32_t> labels(mesh.table.vertex_count());
  for (std::size_t v = 0; v < labels.size(); ++v)
    labels[v] = v < labels.size() / 2 ? 0xFFFFFFFFu : 77;  // any value will do
  const auto result = regularise(mesh.table, labels, {}, mesh.positions);
  EXPECT_EQ(result.region_count, 2u);
  EXPECT_EQ(result.loose_vertex_count, 0u);
  for (std::size_t v = 0; v < labels.size(); ++v)
    EXPECT_EQ(result.region_of_vertex[v], labels[v] == 77 ? 2u : 1u);
}

TEST(Regularise, CutsALabelInTwoWhereItOnlyTouchesItself) {
  // Two opposite quadrants of a grid share a label and meet in the middle vertex.
  constexpr int kSide = 24;
  const TestMesh mesh = mesh_of(shapes::grid(kSide, kSide));
  std::vector<std::uint32_t> labels;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      labels.push_back((x < kSide / 2) == (y < kSide / 2) ? 1 : x < kSide / 2 ? 2 : 3);
  const auto result = regularise(mesh.table, labels, {}, mesh.positions);
  EXPECT_EQ(violation_of(mesh.table, result), "");
  EXPECT_EQ(result.region_count, 4u);
  EXPECT_LE(result.loose_vertex_count, 1u);
}

TEST(Regularise, KeepsDustWholeAndGroupsItByPlace) {
  TriangleSoup soup = shapes::sphere(3);
  for (int i = 0; i < 20; ++i) {  // ten on each side, four vertices each
    const double side = i % 2 == 0 ? -10.0 : 10.0;
    shapes::append(soup, shapes::translated(shapes::tetrahedron(), {side, 0.1 * i, 0}));
  }
  const TestMesh mesh = mesh_of(soup);
  const auto result = regularise(mesh.table, random_labels(mesh.table.vertex_count(), 3, 1),
                                 {.min_component_vertices = 40}, mesh.positions);
  EXPECT_EQ(violation_of(mesh.table, result), "");
  const std::size_t first_dust = shapes::sphere(3).positions.size();
  std::set<RegionId> left, right;
  for (std::size_t v = first_dust; v < mesh.positions.size(); ++v) {
    (mesh.positions[v].x < 0 ? left : right).insert(result.region_of_vertex[v]);
  }
  EXPECT_EQ(left.size(), 1u);
  EXPECT_EQ(right.size(), 1u);
  EXPECT_NE(*left.begin(), *right.begin());
}

TEST(Regularise, NumbersRegionsByFirstVertex) {
  const TestMesh mesh = mesh_of(shapes::torus(16, 40));
  const auto result =
      regularise(mesh.table, noisy_patches(mesh, 6, 3), {.min_piece_triangles = 8}, mesh.positions);
  RegionId highest = 0;
  for (RegionId region : result.region_of_vertex) {
    EXPECT_LE(region, highest + 1);
    highest = std::max(highest, region);
  }
  EXPECT_EQ(highest, result.region_count);
}

TEST(Regularise, TakesAnEmptyMesh) {
  const auto result = regularise({}, {}, {.min_component_vertices = 10}, {});
  EXPECT_EQ(result.region_count, 0u);
}

}  // namespace
}  // namespace selvage
