// SPDX-License-Identifier: MIT
//
// Shapes with parts that anyone would name the same way, made as a scanner would give them, at several
// resolutions; and files with every defect, from soup to labels by triangle.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "common/samples/solid.h"
#include "common/samples/surface_nets.h"
#include "server/ingest/repair.h"
#include "server/segment/segment.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

double bottle_with_handle(const Vec3& p) {
  static const std::array<TubePoint, 4> handle = {
      {{{0.5, 1.7, 0}, 0.14}, {{1.7, 1.5, 0}, 0.14}, {{1.7, 0.2, 0}, 0.14}, {{0.7, 0, 0}, 0.14}}};
  double d = cylinder(p, -1.5, 0.9, 1.0, 0.3);
  d = join(d, cylinder(p, 0.5, 2.4, 0.42, 0.05), 0.04);
  d = join(d, ring(p, 2.4, 0.42, 0.2), 0.04);
  return join(d, tube(p, handle), 0.04);
}

double box(const Vec3& p, const Vec3& half, double rim) {
  const Vec3 d{std::abs(p.x) - half.x + rim, std::abs(p.y) - half.y + rim, std::abs(p.z) - half.z + rim};
  const Vec3 out{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
  return length(out) + std::min(std::max({d.x, d.y, d.z}), 0.0) - rim;
}

/// A plate with a round knob on top.
double box_with_boss(const Vec3& p) {
  return join(box(p, {1.5, 0.4, 1.5}, 0.15), cylinder(p, 0, 1.5, 0.6, 0.1), 0.03);
}

RegionId region_near(const TestMesh& mesh, const Segmentation& segmentation, const Vec3& at) {
  const auto nearest = std::min_element(
      mesh.positions.begin(), mesh.positions.end(),
      [&](const Vec3& a, const Vec3& b) { return dot(a - at, a - at) < dot(b - at, b - at); });
  return segmentation.region_of_vertex[static_cast<std::size_t>(nearest - mesh.positions.begin())];
}

Segmentation segmented(const TestMesh& mesh, const SegmentOptions& options = {}) {
  const Segmentation result = segment(mesh.table, mesh.positions, options, serial_for());
  EXPECT_EQ(violation_of(mesh.table, result), "");
  return result;
}

TEST(KnownParts, ABottleWithAHandleAtThreeResolutions) {
  for (std::uint32_t triangles : {4000u, 12000u, 40000u}) {
    SCOPED_TRACE(triangles);
    const TestMesh mesh =
        mesh_of(scan_solid(bottle_with_handle, {{-1.2, -1.7, -1.2}, {2, 2.8, 1.2}}, triangles));
    const Segmentation result = segmented(mesh);
    const std::set<RegionId> parts = {
        region_near(mesh, result, {-1, -0.5, 0}), region_near(mesh, result, {-0.42, 1.5, 0}),
        region_near(mesh, result, {-0.6, 2.4, 0}), region_near(mesh, result, {1.85, 0.8, 0})};
    EXPECT_EQ(parts.size(), 4u) << "body, neck, lip and handle";
    EXPECT_LE(result.region_count, 7u);
  }
}

TEST(KnownParts, ABossOnABox) {
  const TestMesh mesh = mesh_of(scan_solid(box_with_boss, {{-1.7, -0.6, -1.7}, {1.7, 1.7, 1.7}}, 8000));
  const Segmentation result = segmented(mesh);
  EXPECT_EQ(result.region_count, 2u);
  EXPECT_NE(region_near(mesh, result, {0, 1.5, 0}), region_near(mesh, result, {0, -0.4, 0}));
  EXPECT_NE(region_near(mesh, result, {0.6, 1, 0}), region_near(mesh, result, {1.2, 0.4, 1.2}));
}

TEST(KnownParts, AnOpenBoltIsCutLikeAClosedOne) {
  TriangleSoup soup = shapes::bolt(0.1);
  const double low = std::min_element(soup.positions.begin(), soup.positions.end(), [](auto& a, auto& b) {
                       return a.z < b.z;
                     })->z;
  std::erase_if(soup.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](VertexId v) { return soup.positions[v].z < low + 0.15; });
  });
  const RepairedMesh repaired = repair(soup).value();
  const TestMesh mesh{repaired.table, repaired.positions};
  EXPECT_GT(repaired.report.boundary_edges, 0u);
  const Segmentation result = segmented(mesh);
  EXPECT_EQ(result.region_count, 2u);
}

/// A third sheet on some edges, duplicates, triangles turned, without area and with a repeated corner.
TEST(KnownParts, ADamagedDumbbellStillHasItsThreeParts) {
  TriangleSoup soup = shapes::dumbbell(0.08);
  const std::size_t count = soup.triangles.size();
  for (std::size_t t = 0; t < count; t += 97) {
    const Triangle triangle = soup.triangles[t];
    const auto apex = static_cast<VertexId>(soup.positions.size());
    soup.positions.push_back(soup.positions[triangle[2]] * 1.02);
    soup.triangles.push_back({triangle[0], triangle[1], apex});  // a fin
    soup.triangles.push_back(triangle);                          // twice
    soup.triangles.push_back({triangle[0], triangle[1], triangle[0]});
    std::swap(soup.triangles[t][0], soup.triangles[t][1]);
    soup.positions[triangle[0]] = soup.positions[triangle[1]];  // two triangles without area
  }
  const RepairedMesh repaired = repair(soup).value();
  EXPECT_GT(repaired.report.non_manifold_edges, 0u);
  EXPECT_GT(repaired.report.zero_area_triangles, 0u);
  const TestMesh mesh{repaired.table, repaired.positions};
  const Segmentation result = segmented(mesh);
  std::map<RegionId, std::size_t> sizes;
  for (RegionId region : result.region_of_vertex) ++sizes[region];
  const auto large = std::count_if(
      sizes.begin(), sizes.end(), [&](const auto& size) { return size.second > mesh.positions.size() / 20; });
  EXPECT_GE(large, 3);
  EXPECT_LE(large, 4);
}

}  // namespace
}  // namespace selvage
