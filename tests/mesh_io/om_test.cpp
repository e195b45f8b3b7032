// SPDX-License-Identifier: MIT
#include "common/mesh_io/openmesh_io.h"

#include <sstream>

#include <OpenMesh/Core/IO/MeshIO.hh>

#include "common/mesh_io/openmesh_mesh.h"
#include "tests/mesh_io/support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

TEST(Om, GivesBackExactlyWhatWasWritten) {
  for (const TriangleSoup& soup :
       {shapes::sphere(2), shapes::grid_with_holes(8, 8, 2), shapes::open_cylinder(7, 3)}) {
    const Result<std::string> written = format_om(soup);
    ASSERT_TRUE(written) << written.error().message;
    expect_same(parse_good(parse_om, *written).soup, soup);
  }
}

TEST(Om, KeepsUnreferencedVertices) {
  TriangleSoup soup = shapes::triangle();
  soup.positions.insert(soup.positions.begin(), Vec3{7, 7, 7});
  soup.triangles = {{1, 2, 3}};
  expect_same(parse_good(parse_om, *format_om(soup)).soup, soup);
}

TEST(Om, DropsAttributesThatOpenMeshWrote) {
  Result<OpenMeshTriMesh> mesh = to_openmesh(shapes::sphere(1));
  ASSERT_TRUE(mesh);
  mesh->request_vertex_normals();
  mesh->request_face_normals();
  mesh->update_normals();
  using OpenMesh::IO::Options;
  Options options = Options::Binary;
  options += Options::VertexNormal;
  options += Options::FaceNormal;
  std::ostringstream out;
  ASSERT_TRUE(OpenMesh::IO::write_mesh(*mesh, out, ".om", options));
  const MeshFile file = parse_good(parse_om, out.str());
  expect_same(file.soup, shapes::sphere(1));
  EXPECT_TRUE(has_note(file, "attributes dropped"));
}

TEST(Om, RefusesEveryTruncation) {
  const std::string whole = *format_om(shapes::tetrahedron());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_FALSE(parse(parse_om, std::string_view(whole).substr(0, length)))
        << length << " of " << whole.size();
  }
}

TEST(Om, RefusesAbsurdCountsBeforeReading) {
  for (std::size_t at : {4u, 8u, 12u}) {
    std::string text = *format_om(shapes::tetrahedron());
    text.replace(at, 4, "\xff\xff\xff\x7f");
    expect_error(parse_om, text, "more than the rest of the file can hold");
  }
}

TEST(Om, RefusesOtherFiles) {
  expect_error(parse_om, "OFF\n3 1 0\n", "does not begin with 'OM'");
  expect_error(parse_om, "OMT", "cut short");
  std::string old_version = *format_om(shapes::triangle());
  old_version[3] = 0x20;
  expect_error(parse_om, old_version, "of a version before 2", ErrorCode::Unsupported);
  expect_error(parse_om, *format_om(shapes::triangle()) + "x", "data after the end");
}

}  // namespace
}  // namespace selvage
