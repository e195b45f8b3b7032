// SPDX-License-Identifier: MIT
//
// OpenMesh's readers as an independent witness: on manifold meshes both must find the same vertices and
// triangles, in the files that OpenMesh writes as well as in ours.
#include <cmath>
#include <filesystem>
#include <utility>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <unistd.h>

#include "common/mesh_io/openmesh_mesh.h"
#include "common/mesh_io/read_mesh.h"
#include "common/mesh_io/write_mesh.h"
#include "tests/mesh_io/support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

namespace fs = std::filesystem;
using OpenMesh::IO::Options;

/// To few binary digits: OpenMesh writes text with few decimals, and STL corners are welded by their floats.
TriangleSoup rounded(TriangleSoup soup) {
  for (Vec3& p : soup.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 64) / 64;
  return soup;
}

std::vector<TriangleSoup> manifold_shapes() {
  return {rounded(shapes::tetrahedron()), rounded(shapes::sphere(2)),
          rounded(shapes::grid_with_holes(6, 6, 1)), rounded(shapes::torus(8, 12))};
}

class OpenMeshOracle : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::temp_directory_path() / ("selvage_oracle_" + std::to_string(::getpid()));
  }
  void TearDown() override { fs::remove(path_); }

  void expect_both_read_the_same() {
    OpenMeshTriMesh theirs;
    Options options;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(theirs, path_.string(), options));
    const Result<MeshFile> ours = read_mesh(path_);
    ASSERT_TRUE(ours) << ours.error().to_string();
    const TriangleSoup expected = from_openmesh(theirs);
    EXPECT_EQ(ours->soup.triangles, expected.triangles);
    ASSERT_EQ(ours->soup.positions.size(), expected.positions.size());
    for (std::size_t v = 0; v < expected.positions.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) {  // OpenMesh reads text as float32
        EXPECT_FLOAT_EQ(static_cast<float>(ours->soup.positions[v][axis]),
                        static_cast<float>(expected.positions[v][axis]));
      }
    }
    fs::remove(path_);
  }

  fs::path path_;
};

TEST_F(OpenMeshOracle, ReadsOurFilesAsWeDo) {
  for (const char* extension : {".ply", ".off", ".stl", ".obj", ".om"}) {
    for (const TriangleSoup& soup : manifold_shapes()) {
      SCOPED_TRACE(extension);
      path_.replace_extension(extension);
      ASSERT_TRUE(write_mesh(path_, soup));
      expect_both_read_the_same();
    }
  }
}

TEST_F(OpenMeshOracle, WritesFilesThatWeReadAsItDoes) {
  const std::vector<std::pair<const char*, Options>> kinds = {
      {".ply", Options()},      {".ply", Options::Binary}, {".ply", Options(Options::Binary) + Options::MSB},
      {".off", Options()},      {".obj", Options()},       {".stl", Options()},
      {".stl", Options::Binary}};
  for (const auto& [extension, options] : kinds) {
    for (const TriangleSoup& soup : manifold_shapes()) {
      SCOPED_TRACE(extension);
      path_.replace_extension(extension);
      const Result<OpenMeshTriMesh> mesh = to_openmesh(soup);
      ASSERT_TRUE(mesh);
      ASSERT_TRUE(OpenMesh::IO::write_mesh(*mesh, path_.string(), options));
      expect_both_read_the_same();
    }
  }
}

}  // namespace
}  // namespace selvage
