// SPDX-License-Identifier: MIT
#include "server/segment/hierarchy.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "server/segment/merge_by_depth.h"
#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A flat strip, 12 cells long and 2 wide, in four bands of basins; the border between 1 and 2 is a deep
/// crease.
struct Strip {
  TestMesh mesh = mesh_of(shapes::grid(12, 2));
  Minima basins;
  std::vector<float> kappa;

  Strip() {
    for (Vec3& p : mesh.positions) {
      p.z = 0;
      basins.label_of_vertex.push_back(p.x < 3 ? 0 : p.x < 7 ? 1 : p.x < 10 ? 2 : 3);
      kappa.push_back(p.x == 6 || p.x == 7 ? -0.3f : 0.0f);
    }
    basins.count = 4;
  }
  RegionHierarchy hierarchy(const HierarchyOptions& options = {}) const {
    const Components components = find_components(mesh.table);
    return build_hierarchy(mesh.table, mesh.positions, components,
                           measure_components(mesh.table, mesh.positions, components),
                           measure_vertices(mesh.table, mesh.positions), kappa, basins, options);
  }
};

TEST(Hierarchy, MergesAcrossTheDeepestBorderLast) {
  const RegionHierarchy hierarchy = Strip().hierarchy();
  ASSERT_EQ(hierarchy.merges.size(), 3u);
  EXPECT_EQ(hierarchy.merges.back().a, 0u);
  EXPECT_EQ(hierarchy.merges.back().b, 2u);
  EXPECT_GT(hierarchy.merges.back().saliency, hierarchy.merges.front().saliency);
}

TEST(Hierarchy, AnyPrefixIsASegmentation) {
  const RegionHierarchy hierarchy = Strip().hierarchy();
  for (std::uint32_t regions = 4; regions >= 1; --regions) {
    const Minima labels = hierarchy.labels_after(hierarchy.merges_until(regions));
    EXPECT_EQ(labels.count, regions);
    EXPECT_EQ(*std::max_element(labels.label_of_vertex.begin(), labels.label_of_vertex.end()), regions - 1);
  }
  EXPECT_EQ(hierarchy.merges_until(100), 0u);
  EXPECT_EQ(hierarchy.merges_below(1e9), 3u);
  EXPECT_EQ(hierarchy.merges_below(0), 0u);
}

TEST(Hierarchy, MergesSmallRegionsFirst) {
  const RegionHierarchy hierarchy = Strip().hierarchy({.min_region_vertices = 10});
  EXPECT_EQ(hierarchy.merges.front().b, 1u) << "basin 0 has nine vertices and only basin 1 beside it";
  EXPECT_LT(hierarchy.merges.front().saliency, 1e-3);
}

TEST(Hierarchy, MakesNoRegionAboveTheLimitUnlessASideIsSmall) {
  EXPECT_TRUE(Strip().hierarchy({.max_region_vertices = 17}).merges.empty());
  EXPECT_EQ(Strip().hierarchy({.max_region_vertices = 21}).merges.size(), 2u);
  EXPECT_FALSE(Strip().hierarchy({.min_region_vertices = 10, .max_region_vertices = 17}).merges.empty());
}

TEST(Hierarchy, SaliencyDoesNotDependOnScale) {
  Strip strip;
  const auto before = strip.hierarchy().merges;
  for (Vec3& p : strip.mesh.positions) p = p * 1000;
  const auto after = strip.hierarchy().merges;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i].saliency, before[i].saliency, 1e-6);
}

TEST(MergeByDepth, TheShallowestRegionFlowsOverItsLowestPass) {
  const Strip strip;
  Minima labels = strip.basins;
  std::vector<double> height;
  for (const Vec3& p : strip.mesh.positions) {
    const int x = static_cast<int>(p.x);
    const double heights[13] = {0, 0, 5, 5, 0, 0, 2,
                                2, 1, 3, 3, 0, 0};  // passes 5, 2, 3; basin 2 is one deep
    height.push_back(heights[x]);
  }
  merge_by_depth(strip.mesh.table, height, labels, 3);
  EXPECT_EQ(labels.count, 3u);
  EXPECT_EQ(labels.label_of_vertex[5], labels.label_of_vertex[8]);
  merge_by_depth(strip.mesh.table, height, labels, 2);
  EXPECT_EQ(labels.label_of_vertex[8], labels.label_of_vertex[12]);
  EXPECT_NE(labels.label_of_vertex[0], labels.label_of_vertex[12]);
}

}  // namespace
}  // namespace selvage
