// SPDX-License-Identifier: MIT
#include "common/mesh_io/mesh_builder.h"

#include <array>

#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

TEST(MeshBuilder, RefusesMoreIndicesThanItsLimit) {
  const std::array<std::uint32_t, 3> corners = {0, 1, 2};
  for (int triangles : {2, 3}) {
    MeshBuilder mesh(6);
    for (int v = 0; v < 3; ++v) mesh.add_vertex({});
    for (int t = 0; t < triangles; ++t) mesh.add_polygon(corners);
    const Result<MeshFile> file = std::move(mesh).finish("test");
    EXPECT_EQ(file.has_value(), triangles == 2);
    if (!file) {
      EXPECT_EQ(file.error().code, ErrorCode::LimitExceeded);
    }
  }
}

TEST(MeshBuilder, RefusesMoreVerticesThanItsLimit) {
  MeshBuilder mesh(3);
  for (int v = 0; v < 4; ++v) mesh.add_vertex({});
  EXPECT_EQ(std::move(mesh).finish("test").error().code, ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace selvage
