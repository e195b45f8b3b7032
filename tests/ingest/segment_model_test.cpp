// SPDX-License-Identifier: MIT
#include "server/ingest/segment_model.h"

#include <gtest/gtest.h>

#include "server/ingest/spatial_order.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(SegmentModel, GivesARegionToEveryTriangleOfTheFileInItsOrder) {
  TriangleSoup soup = shapes::dumbbell(0.1);
  soup.triangles.insert(soup.triangles.begin(), {0, 0, 1});  // dropped
  soup.triangles.insert(soup.triangles.begin() + 100, {5, 6, 5});
  const RepairedMesh mesh = spatially_ordered(repair(soup).value());
  const NamedSegmentation result = segment_model(mesh, {}, {}, serial_for());
  const auto regions = regions_of_source_triangles(mesh, result.regions, soup.triangles.size());
  ASSERT_EQ(regions.size(), soup.triangles.size());
  EXPECT_EQ(regions[0], regions[1]);
  EXPECT_EQ(regions[100], regions[99]);
  for (TriangleId t = 0; t < regions.size(); ++t) {
    EXPECT_GE(regions[t], 1u);
    EXPECT_LE(regions[t], result.regions.region_count);
  }
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.table.triangle(t);
    const auto& of_vertex = result.regions.region_of_vertex;
    if (of_vertex[a] == of_vertex[b] && of_vertex[b] == of_vertex[c] && of_vertex[a] != kLooseRegion) {
      EXPECT_EQ(regions[mesh.source_of_triangle[t]], of_vertex[a]);
    }
  }
}

TEST(SegmentModel, CutsByShapeAloneUnlessSizesAreAskedFor) {
  const RepairedMesh mesh = repair(shapes::sphere(6)).value();
  EXPECT_EQ(segment_model(mesh, {}, {}, serial_for()).regions.region_count, 1u);
  const SegmentOptions sized = with_streaming_sizes({}, mesh.table.triangle_count());
  EXPECT_GE(segment_model(mesh, {}, sized, serial_for()).regions.region_count, 4u);
}

}  // namespace
}  // namespace selvage
