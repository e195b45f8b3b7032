// SPDX-License-Identifier: MIT
#include "client/interop/openmesh.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(OpenMeshAdaptor, KeepsIndicesAndDoubles) {
  const TriangleSoup far_off = shapes::translated(shapes::sphere(2), {4.5e6 + 1.0 / 3, 0, 0});
  for (const TriangleSoup& soup : {far_off, shapes::torus(6, 9), shapes::grid_with_holes(8, 8, 2)}) {
    const Result<OpenMeshTriMesh> mesh = to_openmesh(soup);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const TriangleSoup back = from_openmesh(*mesh);
    EXPECT_EQ(back.positions, soup.positions);
    EXPECT_EQ(back.triangles, soup.triangles);
  }
}

TEST(OpenMeshAdaptor, KeepsTwoOpenFansAtOneVertex) {
  const TriangleSoup bow_tie = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                                {{0, 1, 2}, {0, 3, 4}}};
  const Result<OpenMeshTriMesh> mesh = to_openmesh(bow_tie);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(from_openmesh(*mesh).triangles, bow_tie.triangles);
}

TEST(OpenMeshAdaptor, TakesTrianglesInAnyOrder) {
  TriangleSoup soup = shapes::sphere(3);
  std::vector<Triangle> shuffled;
  const std::size_t step = 7 * 37;  // coprime to 512: every triangle once, neighbours far apart
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    shuffled.push_back(soup.triangles[i * step % soup.triangles.size()]);
  soup.triangles = shuffled;
  const Result<OpenMeshTriMesh> mesh = to_openmesh(soup);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(from_openmesh(*mesh).triangles, soup.triangles);
}

TEST(OpenMeshAdaptor, RefusesWhatOpenMeshWouldAlter) {
  struct Case {
    std::vector<Triangle> triangles;
    const char* message;
  };
  const std::vector<Case> cases = {
      {{{0, 1, 2}, {0, 1, 3}},
       "OpenMesh cannot hold triangle 1: another triangle walks one of its edges the same way"},
      {{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, "triangle 2: another triangle walks"},
      {{{0, 1, 1}}, "triangle 0: it has a repeated vertex"},
      {{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}, "triangle 3: one of its vertices is already surrounded"},
  };
  for (const Case& c : cases) {
    const Result<OpenMeshTriMesh> mesh = to_openmesh({std::vector<Vec3>(6), c.triangles});
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(mesh.error().message.find(c.message), std::string::npos) << mesh.error().message;
  }
}

TEST(OpenMeshAdaptor, LeavesDeletedElementsOut) {
  Result<OpenMeshTriMesh> mesh = to_openmesh(shapes::tetrahedron());
  ASSERT_TRUE(mesh);
  mesh->request_vertex_status();
  mesh->request_edge_status();
  mesh->request_face_status();
  mesh->delete_vertex(mesh->vertex_handle(0));
  const TriangleSoup left = from_openmesh(*mesh);
  EXPECT_EQ(left.positions.size(), 3u);
  EXPECT_EQ(left.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

}  // namespace
}  // namespace selvage
