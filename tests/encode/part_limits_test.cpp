// SPDX-License-Identifier: MIT
#include "server/encode/part_limits.h"

#include <gtest/gtest.h>

#include "server/encode/model_encoder.h"
#include "server/ingest/repair.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

Partition one_region(const CornerTable& table) {
  return make_partition(table, std::vector<RegionId>(table.vertex_count(), 1), 1);
}

TEST(PartLimits, CountTrianglesOfClosedRegions) {
  const RepairedMesh mesh = repair(shapes::torus(10, 12)).value();
  const Partition partition = one_region(mesh.table);
  EXPECT_TRUE(check_region_sizes(mesh.table, partition, 240));
  const auto refused = check_region_sizes(mesh.table, partition, 239);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::LimitExceeded);
  EXPECT_NE(refused.error().message.find("region 1 has 240 triangles"), std::string::npos);
}

TEST(PartLimits, CountWhatMayCloseBoundaryLoops) {
  TriangleSoup soup = shapes::torus(10, 12);
  soup.triangles.pop_back();
  const RepairedMesh mesh = repair(soup).value();
  const Partition partition = one_region(mesh.table);
  EXPECT_TRUE(check_region_sizes(mesh.table, partition, 239 + 3));
  EXPECT_FALSE(check_region_sizes(mesh.table, partition, 239 + 2));
}

TEST(PartLimits, RefuseWhatADecoderWouldNotBelieve) {
  // Loose vertices in one place: their number is coded, and no bit of their positions.
  TriangleSoup soup = shapes::torus(500, 500);
  std::fill(soup.positions.begin(), soup.positions.end(), Vec3{1, 2, 3});
  const RepairedMesh mesh = repair(soup).value();
  const Partition partition =
      make_partition(mesh.table, std::vector<RegionId>(mesh.table.vertex_count(), kLooseRegion), 0);
  const ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, partition};
  const auto model = encode_model(source, make_grid(mesh.positions, 12), serial_for(), [] {});
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::LimitExceeded);
  EXPECT_NE(model.error().message.find("region 0 holds more"), std::string::npos);
}

}  // namespace
}  // namespace selvage
