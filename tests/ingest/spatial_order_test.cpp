// SPDX-License-Identifier: MIT
#include "server/ingest/spatial_order.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/ingest/restored.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// Sum over the triangles of how far away in memory their neighbours are.
std::uint64_t total_neighbour_distance(const CornerTable& table) {
  std::uint64_t sum = 0;
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    const CornerId across = table.opposite[c];
    if (across != kNone) sum += std::max(c, across) - std::min(c, across);
  }
  return sum;
}

TEST(SpatialOrder, LosesNothing) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleSoup soup = random_soup(seed);
    auto mesh = repair(soup);
    if (mesh) expect_lossless(spatially_ordered(std::move(*mesh)), soup);
    if (HasFailure()) break;
  }
}

TEST(SpatialOrder, NumbersVerticesByFirstUse) {
  const auto mesh = spatially_ordered(*repair(shapes::sphere(3)));
  VertexId used = 0;
  for (VertexId v : mesh.table.vertex_of_corner) {
    ASSERT_LE(v, used);
    used = std::max(used, v + 1);
  }
}

TEST(SpatialOrder, BringsNeighboursTogether) {
  TriangleSoup soup = shapes::sphere(5);
  std::shuffle(soup.triangles.begin(), soup.triangles.end(), std::mt19937(1));
  const auto shuffled = repair(soup);
  const auto ordered = spatially_ordered(*shuffled);
  EXPECT_LT(total_neighbour_distance(ordered.table), total_neighbour_distance(shuffled->table) / 20);
}

TEST(SpatialOrder, KeepsTheOrderOfTrianglesInOnePlace) {
  TriangleSoup soup = shapes::grid(4, 4);
  for (Vec3& p : soup.positions) p = {1, 2, 3};
  const auto mesh = repair(soup);
  EXPECT_EQ(spatially_ordered(*mesh).source_of_triangle, mesh->source_of_triangle);
}

TEST(SpatialOrder, SurvivesExtremeCoordinates) {
  constexpr double kHuge = std::numeric_limits<double>::max(),
                   kTiny = std::numeric_limits<double>::denorm_min();
  for (double size : {kHuge, kTiny}) {
    TriangleSoup soup = shapes::sphere(1);
    for (Vec3& p : soup.positions) p = {p.x * size, p.y * size, 0};
    expect_lossless(spatially_ordered(*repair(soup)), soup);
  }
}

}  // namespace
}  // namespace selvage
