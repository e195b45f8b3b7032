// SPDX-License-Identifier: MIT
#include <utility>

#include <gtest/gtest.h>

#include "common/codec/region_mesh.h"

namespace selvage {
namespace {

/// An octahedron with the edge 01 twice: 0-1-2 meets 1-0-3 there, and 0-1-4 meets 1-0-5. Each vertex has one
/// fan.
RegionMesh closed() {
  RegionMesh mesh;
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}, {0, 2, 5}, {0, 4, 3}, {1, 3, 4}, {1, 5, 2}};
  mesh.positions.resize(6);
  return mesh;
}

/// The same without its first triangle.
RegionMesh open() {
  RegionMesh mesh = closed();
  mesh.triangles.erase(mesh.triangles.begin());
  mesh.loops = {{0, 2, 1}, {3}};
  mesh.vertex_of_boundary = mesh.loops.vertices;
  return mesh;
}

RegionMesh two_triangles() {
  RegionMesh mesh;
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.positions.resize(6);
  mesh.loops = {{0, 1, 2, 3, 4, 5}, {3, 3}};
  return mesh;
}

TEST(CheckRegionMesh, TakesMeshesThatAreSound) {
  for (const RegionMesh& mesh : {closed(), open(), two_triangles()}) {
    const auto ok = check_region_mesh(mesh);
    EXPECT_TRUE(ok) << ok.error().message;
  }
  RegionMesh loose;
  loose.positions.resize(2);
  loose.loops = {{0, 1}, {2}};
  EXPECT_TRUE(check_region_mesh(loose));
  loose.loops = {};
  EXPECT_FALSE(check_region_mesh(loose));
}

TEST(CheckRegionMesh, RefusesTrianglesThatAreNoSurface) {
  RegionMesh repeated = closed();
  repeated.triangles[3][1] = 1;
  EXPECT_FALSE(check_region_mesh(repeated));
  RegionMesh beyond = closed();
  beyond.triangles[3][2] = 6;
  EXPECT_FALSE(check_region_mesh(beyond));
  RegionMesh turned = closed();
  std::swap(turned.triangles[6][0], turned.triangles[6][1]);
  EXPECT_FALSE(check_region_mesh(turned));
  RegionMesh unused = closed();
  unused.positions.resize(7);
  EXPECT_FALSE(check_region_mesh(unused));
  RegionMesh touching = two_triangles();  // in vertex 2
  touching.triangles = {{0, 1, 2}, {2, 3, 4}};
  touching.positions.resize(5);
  touching.loops = {{0, 1, 2, 3, 4}, {5}};
  EXPECT_FALSE(check_region_mesh(touching));
}

TEST(CheckRegionMesh, RefusesTwoFansAtAVertexOfNoBorder) {
  RegionMesh mesh;  // two tetrahedra that share vertex 0
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  mesh.positions.resize(7);
  EXPECT_FALSE(check_region_mesh(mesh));
}

TEST(CheckRegionMesh, RefusesLoopsThatAreNotTheBorder) {
  for (const BoundaryLoops& loops :
       std::vector<BoundaryLoops>{{{}, {}},
                                  {{0, 1, 2}, {3}},  // against the triangles
                                  {{1, 0, 2}, {3}},  // not from the lowest vertex
                                  {{0, 2, 1}, {2}},
                                  {{0, 2, 1}, {4}},
                                  {{0, 2, 1}, {3, 0}},
                                  {{0, 2, 1, 3}, {3, 1}},
                                  {{0, 2, 6}, {3}},
                                  {{0, 2, 2}, {3}}}) {
    RegionMesh mesh = open();
    mesh.loops = loops;
    EXPECT_FALSE(check_region_mesh(mesh));
  }
  RegionMesh out_of_order = two_triangles();
  out_of_order.loops = {{3, 4, 5, 0, 1, 2}, {3, 3}};
  EXPECT_FALSE(check_region_mesh(out_of_order));
}

TEST(CheckRegionMesh, RefusesWhatIsToldOfOthers) {
  RegionMesh mesh = open();
  mesh.vertex_of_boundary[1] = 6;
  EXPECT_FALSE(check_region_mesh(mesh));
  mesh = open();
  mesh.anchors = {{6, 1}};
  EXPECT_FALSE(check_region_mesh(mesh));
  mesh = open();
  mesh.is_turned.resize(8);
  EXPECT_FALSE(check_region_mesh(mesh));
  mesh = open();
  mesh.exact.resize(5);
  EXPECT_FALSE(check_region_mesh(mesh));
}

}  // namespace
}  // namespace selvage
