// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "server/segment/segment.h"
#include "server/segment/triangle_labels.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

Segmentation segmented(const TestMesh& mesh, const SegmentOptions& options = {}) {
  const Segmentation result = segment(mesh.table, mesh.positions, options, serial_for());
  EXPECT_EQ(violation_of(mesh.table, result), "");
  return result;
}

/// The region of most vertices with z in (low, high).
RegionId region_between(const TestMesh& mesh, const Segmentation& segmentation, double low, double high) {
  std::map<RegionId, int> votes;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].z > low && mesh.positions[v].z < high) ++votes[segmentation.region_of_vertex[v]];
  }
  return std::max_element(votes.begin(), votes.end(), [](auto& a, auto& b) { return a.second < b.second; })
      ->first;
}

TEST(XmrgSegment, ConvexShapesAreOneRegion) {
  EXPECT_EQ(segmented(mesh_of(shapes::sphere(4))).region_count, 1u);
  EXPECT_EQ(segmented(mesh_of(shapes::capped_cylinder(0.1))).region_count, 1u);
}

TEST(XmrgSegment, CutsABoltBetweenHeadAndBodyWhicheverWayItFaces) {
  for (const TriangleSoup& soup : {shapes::bolt(0.1), shapes::inside_out(shapes::bolt(0.1))}) {
    const TestMesh mesh = mesh_of(soup);
    const Segmentation result = segmented(mesh);
    EXPECT_EQ(result.region_count, 2u);
    EXPECT_NE(region_between(mesh, result, 0.5, 3), region_between(mesh, result, 4.5, 5.4));
  }
}

TEST(XmrgSegment, CutsADumbbellIntoBallsAndBar) {
  const TestMesh mesh = mesh_of(shapes::dumbbell(0.08));
  const Segmentation result = segmented(mesh);
  EXPECT_EQ(result.region_count, 3u);
  const std::set<RegionId> parts = {region_between(mesh, result, -0.9, 0.5),
                                    region_between(mesh, result, 1.5, 3.5),
                                    region_between(mesh, result, 4.5, 5.9)};
  EXPECT_EQ(parts.size(), 3u);
}

TEST(XmrgSegment, FindsTheSamePartsOfABottleAtAnyResolution) {
  for (double step : {0.16, 0.08, 0.04, 0.02}) {
    const TestMesh mesh = mesh_of(shapes::bottle(step));
    const Segmentation result = segmented(mesh);
    EXPECT_EQ(result.region_count, 3u) << "body, neck and lip; step " << step;
    EXPECT_NE(region_between(mesh, result, 0.2, 2.5), region_between(mesh, result, 4, 5));
  }
}

TEST(XmrgSegment, CadModeCutsABoxAtItsEdges) {
  const TestMesh mesh = mesh_of(shapes::capped_cylinder(0.05));
  EXPECT_EQ(segmented(mesh, {.mode = SegmentMode::Cad}).region_count, 3u) << "two lids and a wall";
}

TEST(XmrgSegment, ReachesTheNumberOfRegionsAskedFor) {
  const TestMesh mesh = mesh_of(shapes::dumbbell(0.08));
  EXPECT_EQ(segmented(mesh, {.target_regions = 1}).region_count, 1u);
  EXPECT_EQ(segmented(mesh, {.target_regions = 2}).region_count, 2u);
}

TEST(XmrgSegment, StreamingSizesKeepRegionsWithinTheirLimits) {
  const TestMesh mesh = mesh_of(shapes::sphere(6));
  const SegmentOptions options = with_streaming_sizes({}, mesh.table.triangle_count());
  EXPECT_EQ(options.max_region_vertices, 4096u);
  const Segmentation result = segmented(mesh, options);
  std::vector<int> size(result.region_count + 1, 0);
  for (RegionId region : result.region_of_vertex) ++size[region];
  EXPECT_GE(result.region_count, 4u);
  for (RegionId region = 1; region <= result.region_count; ++region) EXPECT_LT(size[region], 2 * 4096);
}

TEST(XmrgSegment, StreamingSizesLeaveSmallModelsAlone) {
  EXPECT_EQ(with_streaming_sizes({}, 20000).max_region_vertices, 0u);
  EXPECT_EQ(with_streaming_sizes({.max_region_vertices = 99}, 20001).max_region_vertices, 99u);
}

TEST(XmrgSegment, StreamingSizesGiveWayToWhatTheUserAskedFor) {
  const SegmentOptions narrow = with_streaming_sizes({.max_region_vertices = 100}, 50000);
  EXPECT_EQ(narrow.max_region_vertices, 100u);
  EXPECT_LT(narrow.min_region_vertices, 100u);
  const SegmentOptions wide = with_streaming_sizes({.min_region_vertices = 9000}, 50000);
  EXPECT_EQ(wide.min_region_vertices, 9000u);
  EXPECT_GT(wide.max_region_vertices, 9000u);
  EXPECT_EQ(with_streaming_sizes({.target_regions = 5}, 50000).max_region_vertices, 0u);
  EXPECT_EQ(with_streaming_sizes({.mode = SegmentMode::Classic}, 50000).min_region_vertices, 0u);
}

TEST(XmrgSegment, TakesEveryOddMeshInEveryMode) {
  for (const auto& [name, mesh] : odd_meshes()) {
    SCOPED_TRACE(name);
    for (SegmentMode mode : {SegmentMode::Xmrg, SegmentMode::Cad, SegmentMode::ManganWhitaker}) {
      for (bool smooth : {false, true})
        segmented(mesh, {.mode = mode, .max_region_vertices = 100, .smooth = smooth});
    }
  }
}

TEST(XmrgSegment, TakesPointsThatCoincide) {
  TestMesh mesh = mesh_of(shapes::torus(12, 20));
  for (Vec3& p : mesh.positions) p = {1, 2, 3};
  EXPECT_EQ(segmented(mesh).region_count, 1u);
}

TEST(XmrgSegment, TakesZeroAreaTriangles) {
  TestMesh mesh = mesh_of(shapes::dumbbell(0.1));
  for (VertexId v = 0; v < mesh.table.vertex_count();
       v += 7) {  // collapse every seventh vertex onto a neighbour
    mesh.positions[v] = mesh.positions[mesh.table.vertex(next(mesh.table.corner_of_vertex[v]))];
  }
  EXPECT_GE(segmented(mesh).region_count, 3u);
}

TEST(TriangleLabels, TakeTheRegionOfTwoCorners) {
  const TestMesh mesh = mesh_of(shapes::grid(2, 1));
  const Segmentation segmentation{{1, 1, 2, kLooseRegion, 1, 2}, 2, 1};
  const auto regions = regions_of_triangles(mesh.table, segmentation);
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.table.triangle(t);
    const auto& r = segmentation.region_of_vertex;
    const int ones = (r[a] == 1) + (r[b] == 1) + (r[c] == 1), twos = (r[a] == 2) + (r[b] == 2) + (r[c] == 2);
    EXPECT_EQ(regions[t], ones >= twos ? 1u : 2u);
  }
}

}  // namespace
}  // namespace selvage
