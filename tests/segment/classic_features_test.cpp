// SPDX-License-Identifier: MIT
#include "server/segment/features.h"

#include <numbers>

#include <gtest/gtest.h>

#include "server/segment/average_plane.h"
#include "server/segment/curvature.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

Features features_of(const TestMesh& mesh, int rings) {
  const Components components = find_components(mesh.table);
  return extract_features(mesh.table, mesh.positions, components,
                          measure_components(mesh.table, mesh.positions, components), rings, serial_for());
}

TEST(Curvature, SumsToTheEulerCharacteristic) {
  // Gauss-Bonnet: the deficits of a closed mesh sum to 2 pi chi.
  const std::vector<std::pair<TriangleSoup, int>> cases = {
      {shapes::sphere(3), 2}, {shapes::torus(9, 14), 0}, {shapes::chain_of_tori(2), -4}};
  for (const auto& [soup, euler] : cases) {
    const TestMesh mesh = mesh_of(soup);
    double sum = 0;
    for (double deficit : features_of(mesh, 1).curvature) sum += deficit;
    EXPECT_NEAR(sum, 2 * std::numbers::pi * euler, 1e-9);
  }
}

TEST(Curvature, IsOneOverRadiusSquaredOnASphere) {
  TestMesh mesh = mesh_of(shapes::sphere(5));
  for (Vec3& p : mesh.positions) p = p * 2;
  RingWalker walker(mesh.table);
  double sum = 0;
  for (VertexId v = 0; v < mesh.table.vertex_count(); ++v)
    sum += gaussian_curvature(mesh.positions, v, walker.walk(v, 1));
  EXPECT_NEAR(sum / mesh.table.vertex_count(), 0.25, 0.01);
}

TEST(AveragePlane, IsTheAreaWeightedMeanOfTheFaces) {
  const TestMesh mesh = mesh_of(shapes::tetrahedron());
  RingWalker walker(mesh.table);
  const Ring ring = walker.walk(0, 1);
  const AveragePlane plane = average_plane(mesh.positions, 0, ring);
  // Three faces of area 1/2 at the origin, on the coordinate planes, outward normals -x, -y, -z.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(plane.normal[axis], -1.0 / 3, 1e-12);
    EXPECT_NEAR(plane.centre[axis], 2.0 / 9, 1e-12);
  }
  EXPECT_NEAR(signed_distance(mesh.positions, 0, ring), 2.0 / 9, 1e-12);
}

TEST(Features, ConvexIsPositiveWhicheverWayTheMeshFaces) {
  for (const TriangleSoup& soup : {shapes::sphere(3), shapes::inside_out(shapes::sphere(3))}) {
    for (int rings : {1, 3}) {
      for (double distance : features_of(mesh_of(soup), rings).distance) EXPECT_GT(distance, 0);
    }
  }
}

TEST(Features, BorderVerticesHaveNoCurvature) {
  const TestMesh mesh = mesh_of(shapes::grid(5, 5));
  EXPECT_EQ(features_of(mesh, 2).curvature[0], 0);
}

TEST(Plateau, IsWhereEitherValueFallsBelowItsShareOfTheLowest) {
  const Features features{{-1.0, -0.02, -0.005, 0.5}, {0.1, 0.1, -2.0, -0.01}};
  EXPECT_EQ(find_plateau(features, {}), (std::vector<std::uint8_t>{1, 1, 1, 0}));
  EXPECT_EQ(find_plateau(features, {.use_distance = false}), (std::vector<std::uint8_t>{1, 1, 0, 0}));
}

TEST(Plateau, IgnoresRoundingOnFlatFaces) {
  // All hyperbolic or concave values of this convex shape are rounding; a threshold relative to them means
  // nothing.
  for (std::uint8_t is_plateau : find_plateau(features_of(mesh_of(shapes::capped_cylinder(0.15)), 1), {})) {
    EXPECT_EQ(is_plateau, 0);
  }
}

TEST(Plateau, IsEmptyOnAConvexSurface) {
  for (std::uint8_t is_plateau : find_plateau(features_of(mesh_of(shapes::sphere(4)), 2), {}))
    EXPECT_EQ(is_plateau, 0);
}

}  // namespace
}  // namespace selvage
