// SPDX-License-Identifier: MIT
#include "tests/ingest/restored.h"

#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "common/mesh/check_corner_table.h"

namespace selvage {
namespace {

constexpr Triangle kNoTriangle = {kNone, kNone, kNone};

}  // namespace

std::vector<Triangle> restored_triangles(const RepairedMesh& mesh, std::size_t soup_triangle_count) {
  std::vector<Triangle> restored(soup_triangle_count, kNoTriangle);
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    Triangle triangle = mesh.table.triangle(t);
    for (VertexId& v : triangle) v = mesh.source_of_vertex.at(v);
    if (mesh.is_turned.at(t)) std::swap(triangle[1], triangle[2]);
    Triangle& place = restored.at(mesh.source_of_triangle.at(t));
    EXPECT_EQ(place, kNoTriangle) << "triangle " << mesh.source_of_triangle[t] << " comes back twice";
    place = triangle;
  }
  return restored;
}

std::vector<Triangle> expected_triangles(const TriangleSoup& soup) {
  std::vector<Triangle> expected = soup.triangles;
  for (Triangle& t : expected) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) t = kNoTriangle;
  }
  return expected;
}

void expect_lossless(const RepairedMesh& mesh, const TriangleSoup& soup) {
  const auto ok = check_corner_table(mesh.table);
  ASSERT_TRUE(ok) << ok.error().message;
  ASSERT_EQ(mesh.source_of_triangle.size(), mesh.table.triangle_count());
  ASSERT_EQ(mesh.is_turned.size(), mesh.table.triangle_count());
  ASSERT_EQ(mesh.source_of_vertex.size(), mesh.table.vertex_count());
  ASSERT_EQ(mesh.positions.size(), mesh.table.vertex_count());
  for (VertexId v = 0; v < mesh.table.vertex_count(); ++v) {
    EXPECT_NE(mesh.table.corner_of_vertex[v], kNone);
    EXPECT_EQ(mesh.positions[v], soup.positions.at(mesh.source_of_vertex[v]));
  }
  EXPECT_EQ(restored_triangles(mesh, soup.triangles.size()), expected_triangles(soup));
}

TriangleSoup random_soup(std::uint32_t seed) {
  std::mt19937 random(seed);
  const std::uint32_t vertices = 3 + random() % 30, triangles = 1 + random() % 120;
  TriangleSoup soup;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    soup.positions.push_back({double(random() % 8), double(random() % 8), double(random() % 8)});
  }
  for (std::uint32_t t = 0; t < triangles; ++t) {
    soup.triangles.push_back({std::uint32_t(random() % vertices), std::uint32_t(random() % vertices),
                              std::uint32_t(random() % vertices)});
  }
  return soup;
}

}  // namespace selvage
