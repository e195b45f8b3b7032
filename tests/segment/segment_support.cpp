// SPDX-License-Identifier: MIT
#include "tests/segment/segment_support.h"

#include <random>

#include <gtest/gtest.h>

#include "common/mesh/check_corner_table.h"
#include "server/segment/check_partition.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// Two triangles that share all vertices of an edge and are cut there, as repair leaves a non-manifold edge:
/// a tetrahedron cut open along the edge 0-1.
TestMesh cut_edge() {
  TestMesh mesh = mesh_of(shapes::tetrahedron());
  for (CornerId c = 0; c < mesh.table.corner_count(); ++c) {
    const auto tail = mesh.table.vertex(next(c)), head = mesh.table.vertex(prev(c));
    if (tail + head == 1) mesh.table.opposite[c] = kNone;
  }
  mesh.table.set_corner_of_vertex(mesh.table.vertex_count());
  const auto ok = check_corner_table(mesh.table);
  EXPECT_TRUE(ok) << ok.error().message;
  return mesh;
}

TriangleSoup many_components() {
  TriangleSoup soup = shapes::sphere(3);
  for (int i = 0; i < 40; ++i) {
    const Vec3 at{3.0 + i % 7, 2.0 * (i % 3), 0.5 * i};
    shapes::append(soup, shapes::translated(i % 2 == 0 ? shapes::triangle() : shapes::tetrahedron(), at));
  }
  shapes::append(soup, shapes::translated(shapes::pillow(), {-4, 0, 0}));
  shapes::append(soup, shapes::translated(shapes::grid(6, 6), {-9, 0, 0}));
  return soup;
}

}  // namespace

TestMesh mesh_of(const TriangleSoup& soup) {
  TestMesh mesh{build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size())),
                soup.positions};
  const auto ok = check_corner_table(mesh.table);
  EXPECT_TRUE(ok) << ok.error().message;
  return mesh;
}

std::vector<std::pair<std::string, TestMesh>> odd_meshes() {
  return {{"triangle", mesh_of(shapes::triangle())},
          {"pillow", mesh_of(shapes::pillow())},
          {"tetrahedron", mesh_of(shapes::tetrahedron())},
          {"cut edge", cut_edge()},
          {"grid with holes", mesh_of(shapes::grid_with_holes(20, 20, 5))},
          {"torus", mesh_of(shapes::torus(16, 40))},
          {"sphere", mesh_of(shapes::sphere(4))},
          {"cylinder", mesh_of(shapes::open_cylinder(12, 30))},
          {"genus 4", mesh_of(shapes::chain_of_tori(3))},
          {"many components", mesh_of(many_components())}};
}

std::vector<std::uint32_t> random_labels(std::size_t vertex_count, std::uint32_t label_count,
                                         std::uint32_t seed) {
  std::mt19937 random(seed);  // its sequence is fixed by the standard; the distributions' is not
  std::vector<std::uint32_t> labels(vertex_count);
  for (std::uint32_t& label : labels) label = random() % label_count;
  return labels;
}

std::string violation_of(const CornerTable& table, const Segmentation& segmentation) {
  const Partition partition = make_partition(table, segmentation.region_of_vertex, segmentation.region_count);
  const auto ok = check_partition(table, partition);
  return ok ? "" : ok.error().message;
}

}  // namespace selvage
