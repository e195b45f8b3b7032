// SPDX-License-Identifier: MIT
#include "server/segment/basins.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "server/segment/cut_large.h"
#include "server/segment/gap_distance.h"
#include "server/segment/smooth_labels.h"
#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A flat grid with unit cells and radius 1; a wall of plateau across the middle, with a gap of `gap`
/// vertices.
struct Wall {
  static constexpr int kSide = 20;
  TestMesh mesh = mesh_of(shapes::grid(kSide, kSide));
  HeightField field;

  explicit Wall(int gap) {
    for (Vec3& p : mesh.positions) p.z = 0;
    field.radius.assign(mesh.positions.size(), 1);
    for (const Vec3& p : mesh.positions) {
      const bool is_wall = p.y == kSide / 2 && std::abs(p.x - kSide / 2) * 2 >= gap;
      field.kappa.push_back(is_wall ? -0.5f : 0.1f);
    }
  }
  std::uint32_t label(const Minima& labels, int x, int y) const {
    return labels.label_of_vertex[y * (kSide + 1) + x];
  }
};

TEST(GapDistance, IsInRadiiAndEndsAtTheReach) {
  Wall wall(0);
  std::fill(wall.field.radius.begin(), wall.field.radius.end(), 2.0f);
  std::vector<std::uint8_t> is_plateau;
  for (float kappa : wall.field.kappa) is_plateau.push_back(kappa < 0);
  const auto distance =
      distance_to_plateau(Neighbours(wall.mesh.table), wall.mesh.positions, is_plateau, wall.field.radius, 3);
  for (std::size_t v = 0; v < distance.size(); ++v) {
    EXPECT_NEAR(distance[v], std::min(3.0, std::abs(wall.mesh.positions[v].y - 10) / 2), 1e-5);
  }
}

TEST(Basins, AreSeparatedByAWall) {
  const Wall wall(0);
  const Minima basins = flood_basins(Neighbours(wall.mesh.table), wall.mesh.positions, wall.field, {});
  EXPECT_EQ(basins.count, 2u);
  EXPECT_NE(wall.label(basins, 10, 2), wall.label(basins, 10, 18));
}

TEST(Basins, ComeApartAtANarrowGapOnly) {
  for (const auto& [gap, expected] : {std::pair{3, 2u}, {15, 1u}}) {
    const Wall wall(gap);
    EXPECT_EQ(flood_basins(Neighbours(wall.mesh.table), wall.mesh.positions, wall.field, {.gap = 2.5}).count,
              expected)
        << gap;
  }
}

TEST(Basins, StayJoinedWithoutGapClosing) {
  const Wall wall(3);
  EXPECT_EQ(flood_basins(Neighbours(wall.mesh.table), wall.mesh.positions, wall.field, {.gap = 0}).count, 1u);
}

TEST(Basins, GiveAComponentThatIsAllPlateauOneLabel) {
  Wall wall(0);
  std::fill(wall.field.kappa.begin(), wall.field.kappa.end(), -1.0f);
  EXPECT_EQ(flood_basins(Neighbours(wall.mesh.table), wall.mesh.positions, wall.field, {}).count, 1u);
}

TEST(CutLarge, MakesCompactPiecesNearTheWantedSize) {
  const TestMesh mesh = mesh_of(shapes::torus(60, 120));
  Minima labels{std::vector<std::uint32_t>(mesh.table.vertex_count(), 0), 1};
  cut_large_regions(Neighbours(mesh.table), labels, 1000);
  EXPECT_EQ(labels.count, 8u);  // 7200 / 900
  std::vector<int> size(labels.count, 0);
  for (std::uint32_t label : labels.label_of_vertex) ++size[label];
  for (int s : size) {
    EXPECT_GT(s, 250);
    EXPECT_LT(s, 1500);
  }
}

TEST(CutLarge, LeavesSmallRegionsAlone) {
  const TestMesh mesh = mesh_of(shapes::torus(20, 20));
  Minima labels{random_labels(mesh.table.vertex_count(), 4, 1), 4};
  const auto before = labels.label_of_vertex;
  cut_large_regions(Neighbours(mesh.table), labels, 400);
  EXPECT_EQ(labels.label_of_vertex, before);
}

TEST(SmoothLabels, StraightensAJaggedBorder) {
  const TestMesh mesh = mesh_of(shapes::torus(60, 60));
  Minima labels{std::vector<std::uint32_t>(mesh.table.vertex_count()), 2};
  for (std::uint32_t v = 0; v < labels.label_of_vertex.size(); ++v) {
    labels.label_of_vertex[v] = (v / 60 + (v % 4 == 0 ? 2 : 0)) % 60 < 30;
  }
  const auto cut_edges = [&] {
    int cut = 0;
    for (CornerId c = 0; c < mesh.table.corner_count(); ++c) {
      cut += labels.label_of_vertex[mesh.table.vertex(next(c))] !=
             labels.label_of_vertex[mesh.table.vertex(prev(c))];
    }
    return cut;
  };
  const int before = cut_edges();
  smooth_labels(Neighbours(mesh.table), std::vector<float>(mesh.table.vertex_count(), 0), labels);
  EXPECT_LT(cut_edges(), before * 3 / 4);
}

}  // namespace
}  // namespace selvage
