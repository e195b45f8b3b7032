// SPDX-License-Identifier: MIT
#include "tests/corpus/restore_mesh.h"

#include <gtest/gtest.h>

#include "common/mesh_io/write_mesh.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

TEST(RestoreMesh, RestoresOverLoopbackWhatItPacked) {
  const TempFolder folder;
  TriangleSoup soup = shapes::torus(40, 120);
  shapes::append(soup, shapes::translated(shapes::grid_with_holes(20, 20, 4), {20, 0, 0}));
  soup.triangles.push_back({0, 1, 500});  // a third triangle at an edge
  soup.triangles.push_back({7, 7, 9});
  ASSERT_TRUE(write_mesh(folder.path() / "mesh.ply", soup));
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    const auto result = restore_mesh(folder.path() / "mesh.ply", seed);
    ASSERT_TRUE(result) << result.error().to_string();
    EXPECT_EQ(result->failure, "");
    EXPECT_EQ(result->triangles, soup.triangles.size() - 1);
  }
}

TEST(RestoreMesh, RefusesWhatIsNoMesh) {
  const TempFolder folder;
  folder.put("text.ply", std::as_bytes(std::span("ply\nformat nonsense")));
  const auto result = restore_mesh(folder.path() / "text.ply", 1);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("text.ply"), std::string::npos);
}

}  // namespace
}  // namespace selvage
