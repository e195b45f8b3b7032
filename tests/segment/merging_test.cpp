// SPDX-License-Identifier: MIT
#include <set>

#include <gtest/gtest.h>

#include "server/segment/erosion.h"
#include "server/segment/merge_by_size.h"
#include "server/segment/minima.h"
#include "server/segment/neighbours.h"
#include "server/segment/one_ring.h"
#include "server/segment/prune_branches.h"
#include "server/segment/region_graph.h"
#include "tests/segment/segment_support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A strip of cells: column x has vertices x and x + columns + 1.
TestMesh strip(int columns) { return mesh_of(shapes::grid(columns, 1)); }

std::vector<std::uint32_t> twice(std::vector<std::uint32_t> row) {
  row.insert(row.end(), row.begin(), row.end());
  return row;
}

TEST(Neighbours, AreThoseAroundEachVertex) {
  for (const auto& [name, mesh] : odd_meshes()) {
    SCOPED_TRACE(name);
    const Neighbours neighbours(mesh.table);
    for (VertexId v = 0; v < mesh.table.vertex_count(); ++v) {
      std::multiset<VertexId> around, listed(neighbours[v].begin(), neighbours[v].end());
      for_each_neighbour(mesh.table, v, [&](VertexId u) { around.insert(u); });
      EXPECT_EQ(listed, around);
    }
  }
}

TEST(Minima, AreTheConnectedSetsOutsideThePlateau) {
  const std::vector<std::uint32_t> plateau_row = {0, 0, 1, 0, 1, 1, 0};
  const auto flags = twice(plateau_row);
  const Minima minima =
      label_minima(Neighbours(strip(6).table), std::vector<std::uint8_t>(flags.begin(), flags.end()));
  EXPECT_EQ(minima.count, 3u);
  EXPECT_EQ(minima.label_of_vertex, twice({0, 0, kNone, 1, kNone, kNone, 2}));
}

TEST(Erosion, GrowsAllBasinsAtTheSameSpeed) {
  Minima minima{twice({0, kNone, kNone, kNone, kNone, kNone, 1}), 2};
  erode_plateau(Neighbours(strip(6).table), minima);
  for (int x : {0, 1, 2}) EXPECT_EQ(minima.label_of_vertex[x], 0u);
  for (int x : {4, 5, 6}) EXPECT_EQ(minima.label_of_vertex[x], 1u);
}

TEST(Erosion, MakesARegionOfAComponentThatIsAllPlateau) {
  TriangleSoup soup = shapes::sphere(1);
  shapes::append(soup, shapes::translated(shapes::sphere(1), {5, 0, 0}));
  const TestMesh mesh = mesh_of(soup);
  Minima minima{std::vector<std::uint32_t>(mesh.table.vertex_count(), kNone), 1};
  minima.label_of_vertex[0] = 0;
  erode_plateau(Neighbours(mesh.table), minima);
  EXPECT_EQ(minima.count, 2u);
  EXPECT_EQ(minima.label_of_vertex.front(), 0u);
  EXPECT_EQ(minima.label_of_vertex.back(), 1u);
}

TEST(MergeBySize, JoinsTheNeighbourWithTheLongestBoundary) {
  // A 5 x 5 vertex grid: left columns 0, right columns 2, and a block 1 that touches the right more.
  const TestMesh mesh = mesh_of(shapes::grid(4, 4));
  std::vector<std::uint32_t> labels = {0, 0, 2, 2, 2,  //
                                       0, 0, 2, 2, 2,  //
                                       0, 0, 1, 1, 2,  //
                                       0, 0, 2, 2, 2,  //
                                       0, 0, 2, 2, 2};
  EXPECT_EQ(merge_by_size(mesh.table, labels, 3, 3), 2u);
  EXPECT_EQ(labels[12], labels[4]);
  EXPECT_NE(labels[12], labels[0]);
}

TEST(MergeBySize, EndsWhereSmallRegionsHaveNoNeighbours) {
  TriangleSoup soup = shapes::triangle();
  shapes::append(soup, shapes::translated(shapes::triangle(), {5, 0, 0}));
  std::vector<std::uint32_t> labels = {0, 0, 0, 1, 1, 1};
  EXPECT_EQ(merge_by_size(mesh_of(soup).table, labels, 2, 1000), 2u);
}

TEST(MergeBySize, LeavesNoSmallRegionThatHasNeighbours) {
  const TestMesh mesh = mesh_of(shapes::torus(30, 60));
  std::vector<std::uint32_t> labels = random_labels(mesh.table.vertex_count(), 500, 7);
  const std::uint32_t count = merge_by_size(mesh.table, labels, 500, 50);
  std::vector<std::uint32_t> sizes(count, 0);
  for (std::uint32_t label : labels) ++sizes[label];
  for (std::uint32_t size : sizes) EXPECT_GE(size, 50u);
}

TEST(RegionGraph, MergingAddsBorders) {
  const TestMesh mesh = strip(3);
  RegionGraph graph(mesh.table, twice({0, 1, 2, 3}), 4);
  const std::uint32_t before = graph.neighbours(1).at(2).edges;
  const std::uint32_t node = graph.merge(2, 3);
  EXPECT_EQ(graph.find(2), graph.find(3));
  EXPECT_EQ(graph.vertex_count(node), 4u);
  EXPECT_EQ(graph.neighbours(1).size(), 2u);
  EXPECT_EQ(graph.neighbours(1).at(node).edges, before);
}

TEST(PruneBranches, GivesAStickOutVertexToItsNeighbourRegion) {
  const TestMesh mesh = mesh_of(shapes::grid(6, 6));
  std::vector<std::uint32_t> labels(49, 0);
  for (int v = 35; v < 49; ++v) labels[v] = 1;
  labels[31] = labels[24] = 1;  // sticks out of its region by two rows: Fig. 4.10's edge 31-24
  EXPECT_EQ(prune_branches(mesh.table, labels), 1u);
  EXPECT_EQ(labels[24], 0u);
  EXPECT_EQ(labels[31], 1u);
}

}  // namespace
}  // namespace selvage
