// SPDX-License-Identifier: MIT
#include "server/segment/partition.h"

#include <functional>

#include <gtest/gtest.h>

#include "server/segment/check_partition.h"
#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A cylinder of 31 rings of 12 vertices, its lower half region 1, its upper half region 2.
struct TwoHalves {
  TestMesh mesh = mesh_of(shapes::open_cylinder(12, 30));
  std::vector<RegionId> regions;
  TwoHalves() {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      regions.push_back(mesh.positions[v].z < 15 ? 1 : 2);
  }
  Partition partition() const { return make_partition(mesh.table, regions, 2); }
};

TEST(Partition, SortsTrianglesByRegion) {
  const TwoHalves halves;
  const Partition partition = halves.partition();
  EXPECT_EQ(partition.triangles_of(0).size(), 0u);
  EXPECT_EQ(partition.triangles_of(1).size(), 14u * 24);
  EXPECT_EQ(partition.triangles_of(2).size(), 15u * 24);
  EXPECT_EQ(partition.boundary_triangles.size(), 24u);
  const auto ok = check_partition(halves.mesh.table, partition);
  EXPECT_TRUE(ok) << ok.error().message;
}

TEST(Partition, PutsTrianglesOfLooseVerticesAmongTheBoundary) {
  const TestMesh mesh = mesh_of(shapes::tetrahedron());
  const Partition partition = make_partition(mesh.table, std::vector<RegionId>(4, kLooseRegion), 0);
  EXPECT_EQ(partition.boundary_triangles.size(), 4u);
  EXPECT_TRUE(check_partition(mesh.table, partition));
}

/// The part of the message that names the guarantee broken.
std::string finding(const TestMesh& mesh, const Partition& partition) {
  const auto ok = check_partition(mesh.table, partition);
  return ok ? "nothing" : ok.error().message;
}

TEST(CheckPartition, SeesListsThatDoNotHoldEveryTriangleOnce) {
  const TwoHalves halves;
  const std::vector<std::pair<const char*, std::function<void(Partition&)>>> damages = {
      {"missing", [](Partition& p) { p.boundary_triangles.pop_back(); }},
      {"not ascending", [](Partition& p) { p.boundary_triangles[1] = p.boundary_triangles[0]; }},
      {"not ascending", [](Partition& p) { std::swap(p.region_triangles[0], p.region_triangles[1]); }},
      {"wrong place", [](Partition& p) { --p.region_triangles_begin[2]; }},
      {"no such triangle", [](Partition& p) { p.boundary_triangles.back() = 100000; }},
      {"out of range", [](Partition& p) { p.region_of_vertex[3] = 3; }},
      {"labels do not match", [](Partition& p) { p.region_of_vertex.pop_back(); }},
      {"ranges", [](Partition& p) { p.region_triangles_begin.pop_back(); }},
      {"no triangle in region",
       [](Partition& p) { p.region_triangles_begin[2] = p.region_triangles_begin[3]; }},
  };
  for (const auto& [expected, damage] : damages) {
    Partition partition = halves.partition();
    damage(partition);
    EXPECT_NE(finding(halves.mesh, partition).find(expected), std::string::npos)
        << finding(halves.mesh, partition);
  }
}

TEST(CheckPartition, SeesAVertexWithoutInteriorTriangle) {
  TwoHalves halves;
  halves.regions[5] = 2;  // alone among region 1
  EXPECT_NE(finding(halves.mesh, halves.partition()).find("no interior triangle"), std::string::npos);
}

TEST(CheckPartition, SeesARegionThatTouchesItselfInAVertex) {
  const TestMesh mesh = mesh_of(shapes::grid(6, 6));
  std::vector<RegionId> regions;  // two quadrants that share the middle vertex, (3, 3)
  for (int y = 0; y <= 6; ++y) {
    for (int x = 0; x <= 6; ++x) regions.push_back((x <= 3 && y >= 3) || (x >= 3 && y <= 3) ? 1 : 2);
  }
  EXPECT_NE(finding(mesh, make_partition(mesh.table, regions, 2)).find("more than one fan"),
            std::string::npos);
}

TEST(CheckPartition, SeesARegionOfTwoPieces) {
  TwoHalves halves;
  for (std::size_t v = 0; v < halves.regions.size(); ++v) {
    const double z = halves.mesh.positions[v].z;
    halves.regions[v] = z < 10 || z > 20 ? 1 : 2;
  }
  EXPECT_NE(finding(halves.mesh, halves.partition()).find("several pieces"), std::string::npos);
}

TEST(CheckPartition, AllowsWholeComponentsInOneRegion) {
  TriangleSoup soup = shapes::tetrahedron();
  shapes::append(soup, shapes::translated(shapes::grid(3, 3), {4, 0, 0}));
  const TestMesh mesh = mesh_of(soup);
  const std::vector<RegionId> regions(mesh.positions.size(), 1);
  EXPECT_EQ(finding(mesh, make_partition(mesh.table, regions, 1)), "nothing");
}

}  // namespace
}  // namespace selvage
