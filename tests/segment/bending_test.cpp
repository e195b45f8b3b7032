// SPDX-License-Identifier: MIT
#include "server/segment/bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "server/segment/height_field.h"
#include "server/segment/one_ring.h"
#include "server/segment/samples.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Geodesic, GoesStraightOnAPlane) {
  TestMesh mesh = mesh_of(shapes::grid(20, 20));
  for (Vec3& p : mesh.positions) p.z = 0;
  const GeodesicTracer tracer(mesh.table, mesh.positions);
  const VertexId middle = 10 * 21 + 10;
  for_each_corner_at(mesh.table, middle, [&](CornerId c) {
    const Vec3 edge = mesh.positions[mesh.table.vertex(next(c))] - mesh.positions[middle];
    const double angle = 0.3, turned = std::atan2(edge.y, edge.x) + angle;
    const GeodesicEnd end = tracer.trace(c, angle, 7.5);
    EXPECT_DOUBLE_EQ(end.length, 7.5);
    EXPECT_NEAR(end.point.x, 10 + 7.5 * std::cos(turned), 1e-5);
    EXPECT_NEAR(end.point.y, 10 + 7.5 * std::sin(turned), 1e-5);
  });
}

TEST(Geodesic, StopsAtTheBorder) {
  TestMesh mesh = mesh_of(shapes::grid(4, 4));
  for (Vec3& p : mesh.positions) p.z = 0;
  const GeodesicTracer tracer(mesh.table, mesh.positions);
  const CornerId start = mesh.table.corner_of_vertex[2 * 5 + 2];
  const GeodesicEnd end = tracer.trace(start, 0.1, 100);
  EXPECT_LT(end.length, 3);
  EXPECT_NEAR(length(end.point - Vec3{2, 2, 0}), end.length, 1e-5);
  const double nearest_side = std::min({end.point.x, end.point.y, 4 - end.point.x, 4 - end.point.y});
  EXPECT_NEAR(nearest_side, 0, 1e-5);
}

TEST(Geodesic, KeepsItsLengthAroundACylinder) {
  // A quarter turn around a fine cylinder of radius 1 ends a quarter turn away.
  const TestMesh mesh = mesh_of(shapes::open_cylinder(400, 20));
  const GeodesicTracer tracer(mesh.table, mesh.positions);
  const VertexId v = 400 * 10;
  for_each_corner_at(mesh.table, v, [&](CornerId c) {
    if (mesh.table.vertex(next(c)) != v + 1) return;  // along the ring
    const GeodesicEnd end = tracer.trace(c, 0, kPi / 2);
    EXPECT_NEAR(end.point.x, 0, 1e-3);
    EXPECT_NEAR(end.point.y, 1, 1e-3);
  });
}

TEST(Bending, OfASphereIsRadiusOverRadiusInAllDirections) {
  const TestMesh mesh = mesh_of(shapes::sphere(6));
  const GeodesicTracer tracer(mesh.table, mesh.positions);
  for (VertexId v = 0; v < mesh.table.vertex_count(); v += 501) {
    const Bending bending = measure_bending(mesh.table, mesh.positions, tracer, v, 0.2, 1);
    EXPECT_NEAR(bending.mean, 0.2, 0.01);
    EXPECT_NEAR(bending.amplitude, 0, 0.01);
    EXPECT_NEAR(measure_bending(mesh.table, mesh.positions, tracer, v, 0.2, -1).mean, -bending.mean, 1e-12);
  }
}

TEST(Bending, OfACylinderIsNothingAlongItsAxis) {
  const TestMesh mesh = mesh_of(shapes::open_cylinder(60, 30));
  const GeodesicTracer tracer(mesh.table, mesh.positions);
  const Bending bending = measure_bending(mesh.table, mesh.positions, tracer, 60 * 15 + 7, 0.5, 1);
  EXPECT_NEAR(bending.least(), 0, 0.02);
  EXPECT_NEAR(bending.greatest(), 0.5, 0.03);
}

TEST(Samples, LeaveNoVertexUncovered) {
  const TestMesh mesh = mesh_of(shapes::torus(40, 80));
  const std::vector<std::uint8_t> spacing(mesh.table.vertex_count(), 4);
  const auto samples = choose_samples(mesh.table, spacing);
  EXPECT_LT(samples.size(), mesh.table.vertex_count() / 8);
  std::vector<float> value(mesh.table.vertex_count(), -1);
  for (VertexId v : samples) value[v] = 3;
  spread_from_samples(mesh.table, samples, 2, value);
  for (float x : value) EXPECT_EQ(x, 3);
}

TEST(HeightField, IsLowInTheCreaseOfABoltOnly) {
  const TestMesh mesh = mesh_of(shapes::bolt(0.1));
  const Components components = find_components(mesh.table);
  const HeightField field = measure_height(mesh.table, mesh.positions, components,
                                           measure_components(mesh.table, mesh.positions, components),
                                           measure_vertices(mesh.table, mesh.positions), {}, serial_for());
  float highest_in_crease = -1, lowest_elsewhere = 1;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const double from_crease = std::hypot(std::hypot(p.x, p.y) - 1, p.z - 4);
    if (from_crease < 1e-9) highest_in_crease = std::max(highest_in_crease, field.kappa[v]);
    if (from_crease > 2 * field.radius[v]) lowest_elsewhere = std::min(lowest_elsewhere, field.kappa[v]);
  }
  EXPECT_LT(highest_in_crease, -0.3);
  EXPECT_GT(lowest_elsewhere, -0.1) << "beside a sharp convex edge the two harmonics fit badly";
}

}  // namespace
}  // namespace selvage
