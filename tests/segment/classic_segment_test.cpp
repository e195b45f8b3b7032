// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "server/segment/segment.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

Segmentation classic(const TestMesh& mesh, SegmentOptions options = {.mode = SegmentMode::Classic}) {
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

TEST(ClassicSegment, ConvexShapesAreOneRegion) {
  EXPECT_EQ(classic(mesh_of(shapes::sphere(4))).region_count, 1u);
  EXPECT_EQ(classic(mesh_of(shapes::capped_cylinder(0.15)), {.xmr_rings = 1}).region_count, 1u);
}

TEST(ClassicSegment, CutsABoltBetweenHeadAndBody) {
  for (const TriangleSoup& soup : {shapes::bolt(0.15), shapes::inside_out(shapes::bolt(0.15))}) {
    const TestMesh mesh = mesh_of(soup);
    for (int rings : {1, 2, 3, 5}) {
      SCOPED_TRACE(rings);
      const Segmentation result = classic(mesh, {.mode = SegmentMode::Classic, .xmr_rings = rings});
      // A decimated ring that crosses a sharp edge looks hyperbolic, so larger L cuts off splinters beside
      // it.
      if (rings <= 2) {
        EXPECT_EQ(result.region_count, 2u);
      }
      EXPECT_NE(region_between(mesh, result, 0.5, 3), region_between(mesh, result, 4.5, 5.4));
    }
  }
}

TEST(ClassicSegment, CutsADumbbellIntoBallsAndBar) {
  const TestMesh mesh = mesh_of(shapes::dumbbell(0.1));
  const Segmentation result = classic(mesh);
  const std::set<RegionId> parts = {region_between(mesh, result, -0.9, 0.5),
                                    region_between(mesh, result, 1.5, 3.5),
                                    region_between(mesh, result, 4.5, 5.9)};
  EXPECT_EQ(parts.size(), 3u);
}

TEST(ClassicSegment, TakesEveryOddMesh) {
  for (const auto& [name, mesh] : odd_meshes()) {
    SCOPED_TRACE(name);
    for (SegmentMode mode : {SegmentMode::Classic, SegmentMode::Zhang}) {
      for (int rings : {-1, 1, 3, 99})
        classic(mesh, {.mode = mode, .xmr_rings = rings, .prune_branches = rings > 1});
    }
  }
}

TEST(ClassicSegment, TakesPointsThatCoincide) {
  TestMesh mesh = mesh_of(shapes::torus(12, 20));
  for (Vec3& p : mesh.positions) p = {1, 2, 3};
  classic(mesh);
}

TEST(ClassicSegment, DoesNotDependOnThreads) {
  const TestMesh mesh = mesh_of(shapes::torus(64, 128));
  const auto serial = segment(mesh.table, mesh.positions, {}, serial_for());
  const auto threaded = segment(mesh.table, mesh.positions, {}, threaded_for(2));
  EXPECT_EQ(serial.region_of_vertex, threaded.region_of_vertex);
}

}  // namespace
}  // namespace selvage
