// SPDX-License-Identifier: MIT
#include "server/segment/bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "server/segment/height_field.h"
#include "server/segment/samples.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr double kPi = std::numbers::pi;

/// The ends of eight geodesics from v, and the angle between one and the next.
std::array<GeodesicEnd, 8> shoot(const TestMesh& mesh, VertexId v, double length) {
  const GeodesicTracer tracer(mesh.table, mesh.positions, serial_for());
  GeodesicTracer::Scratch scratch;
  std::array<GeodesicEnd, 8> ends;
  tracer.shoot(v, length, scratch, ends);
  return ends;
}

Bending bending_at(const TestMesh& mesh, VertexId v, double radius, double outward = 1) {
  const GeodesicTracer tracer(mesh.table, mesh.positions, serial_for());
  GeodesicTracer::Scratch scratch;
  return measure_bending(mesh.table, tracer, v, radius, outward, scratch);
}

Vec3 first_edge(const TestMesh& mesh, VertexId v) {
  return mesh.positions[mesh.table.vertex(next(mesh.table.corner_of_vertex[v]))] - mesh.positions[v];
}

TEST(Geodesic, GoesStraightOnAPlane) {
  TestMesh mesh = mesh_of(shapes::grid(20, 20));
  for (Vec3& p : mesh.positions) p.z = 0;
  const VertexId middle = 10 * 21 + 10;
  const Vec3 edge = first_edge(mesh, middle);
  const auto ends = shoot(mesh, middle, 7.5);
  for (int j = 0; j < 8; ++j) {
    const double angle = std::atan2(edge.y, edge.x) + (j + 0.5) * kPi / 4;
    EXPECT_DOUBLE_EQ(ends[j].length, 7.5);
    EXPECT_NEAR(ends[j].way.x, 7.5 * std::cos(angle), 1e-5);
    EXPECT_NEAR(ends[j].way.y, 7.5 * std::sin(angle), 1e-5);
  }
}

TEST(Geodesic, StopsAtTheBorder) {
  TestMesh mesh = mesh_of(shapes::grid(4, 4));
  for (Vec3& p : mesh.positions) p.z = 0;
  for (const auto& [way, length] : shoot(mesh, 2 * 5 + 2, 100)) {
    EXPECT_NEAR(selvage::length(way), length, 1e-5);
    EXPECT_NEAR(std::max(std::abs(way.x), std::abs(way.y)), 2, 1e-5);
  }
}

TEST(Geodesic, MayEndInItsFirstTriangle) {
  TestMesh mesh = mesh_of(shapes::grid(4, 4));
  for (Vec3& p : mesh.positions) p.z = 0;
  for (const auto& [way, length] : shoot(mesh, 2 * 5 + 2, 0.25)) {
    EXPECT_DOUBLE_EQ(length, 0.25);
    EXPECT_NEAR(selvage::length(way), 0.25, 1e-6);
  }
}

TEST(Geodesic, KeepsItsLengthAndDirectionAroundACylinder) {
  const TestMesh mesh = mesh_of(shapes::open_cylinder(400, 400));  // radius 1
  const VertexId v = 400 * 200;
  const Vec3 at = mesh.positions[v], edge = first_edge(mesh, v);
  const double turned = std::atan2(edge.z, at.x * edge.y - at.y * edge.x);
  const double length = 1.5;
  const auto ends = shoot(mesh, v, length);
  for (int j = 0; j < 8; ++j) {
    const double angle = turned + (j + 0.5) * kPi / 4;
    const double around = std::atan2(at.y, at.x) + length * std::cos(angle);
    const Vec3 end = at + ends[j].way;
    EXPECT_NEAR(end.x, std::cos(around), 2e-3);
    EXPECT_NEAR(end.y, std::sin(around), 2e-3);
    EXPECT_NEAR(end.z - at.z, length * std::sin(angle), 2e-3);
  }
}

TEST(Bending, OfASphereIsRadiusOverRadiusInAllDirections) {
  const TestMesh mesh = mesh_of(shapes::sphere(6));
  for (VertexId v = 0; v < mesh.table.vertex_count(); v += 501) {
    const Bending bending = bending_at(mesh, v, 0.2);
    EXPECT_NEAR(bending.mean, 0.2, 0.01);
    EXPECT_NEAR(bending.amplitude, 0, 0.01);
    EXPECT_NEAR(bending_at(mesh, v, 0.2, -1).mean, -bending.mean, 1e-12);
  }
}

TEST(Bending, OfACylinderIsNothingAlongItsAxis) {
  const TestMesh mesh = mesh_of(shapes::open_cylinder(60, 30));
  const Bending bending = bending_at(mesh, 60 * 15 + 7, 0.5);
  EXPECT_NEAR(bending.least(), 0, 0.02);
  EXPECT_NEAR(bending.greatest(), 0.5, 0.03);
}

TEST(Samples, LeaveNoVertexUncovered) {
  const TestMesh mesh = mesh_of(shapes::torus(40, 80));
  const Neighbours neighbours(mesh.table);
  const std::vector<std::uint8_t> spacing(mesh.table.vertex_count(), 4);
  const Samples samples = choose_samples(mesh.table, neighbours, spacing, serial_for());
  EXPECT_LT(samples.vertices.size(), mesh.table.vertex_count() / 8);
  std::vector<float> value(mesh.table.vertex_count(), -1);
  for (VertexId v : samples.vertices) value[v] = 3;
  spread_from_samples(neighbours, samples, 2, value, serial_for());
  for (float x : value) EXPECT_EQ(x, 3);
}

TEST(Samples, AreAsFewInSlicesAndInAnyVertexOrder) {
  const auto count = [](const TestMesh& mesh) {
    const std::vector<std::uint8_t> spacing(mesh.table.vertex_count(), 4);
    return choose_samples(mesh.table, Neighbours(mesh.table), spacing, serial_for()).vertices.size();
  };
  TriangleSoup soup = shapes::torus(200, 200);  // enough for several slices
  const std::size_t in_order = count(mesh_of(soup));
  const auto vertices = static_cast<VertexId>(soup.positions.size());
  for (Triangle& t : soup.triangles) {
    for (VertexId& v : t)
      v = static_cast<VertexId>(std::uint64_t{v} * 7919 % vertices);  // connectivity matters only
  }
  const std::size_t scattered = count(mesh_of(soup));
  EXPECT_LT(in_order, vertices / 8);
  EXPECT_LT(scattered, in_order * 5 / 4);
}

TEST(HeightField, IsLowInTheCreaseOfABoltOnly) {
  const TestMesh mesh = mesh_of(shapes::bolt(0.1));
  const Components components = find_components(mesh.table);
  const HeightField field = measure_height(mesh.table, Neighbours(mesh.table), mesh.positions, components,
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
