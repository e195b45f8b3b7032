// SPDX-License-Identifier: MIT
//
// The same shape in another position, size, order or sampling is cut alike.
#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "server/segment/segment.h"
#include "tests/segment/segment_support.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

std::vector<RegionId> regions_of(const TestMesh& mesh, const ParallelFor& parallel = serial_for()) {
  return segment(mesh.table, mesh.positions, {}, parallel).region_of_vertex;
}

/// One minus the Rand index over vertices.
double rand_difference(const std::vector<RegionId>& a, const std::vector<RegionId>& b) {
  const auto pairs = [](double n) { return n * (n - 1) / 2; };
  std::map<RegionId, double> in_a, in_b;
  std::map<std::pair<RegionId, RegionId>, double> in_both;
  for (std::size_t v = 0; v < a.size(); ++v) ++in_a[a[v]], ++in_b[b[v]], ++in_both[{a[v], b[v]}];
  double sum = 0;
  for (const auto& [region, n] : in_a) sum += pairs(n);
  for (const auto& [region, n] : in_b) sum += pairs(n);
  for (const auto& [region, n] : in_both) sum -= 2 * pairs(n);
  return sum / pairs(static_cast<double>(a.size()));
}

TEST(Stability, ThreadsDoNotMatter) {
  const TestMesh mesh = mesh_of(shapes::bottle(0.04));
  EXPECT_EQ(regions_of(mesh), regions_of(mesh, threaded_for(2)));
}

TEST(Stability, ScaleByAPowerOfTwoChangesNothing) {
  TestMesh mesh = mesh_of(shapes::bottle(0.06));
  const auto before = regions_of(mesh);
  for (Vec3& p : mesh.positions) p = p * 1024;
  EXPECT_EQ(regions_of(mesh), before);
}

TEST(Stability, RotationMovesAFewVerticesAtMost) {
  TestMesh mesh = mesh_of(shapes::dumbbell(0.06));
  const auto before = regions_of(mesh);
  for (Vec3& p : mesh.positions) {
    p = {0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y, 0.48 * p.x + 0.64 * p.y + 0.6 * p.z};
    p += Vec3{100, -20, 3};
  }
  EXPECT_LE(rand_difference(before, regions_of(mesh)), 0.005);
}

TEST(Stability, VertexAndTriangleOrderHardlyMatter) {
  for (const TriangleSoup& soup : {shapes::bottle(0.04), shapes::dumbbell(0.04)}) {
    const auto before = regions_of(mesh_of(soup));
    std::mt19937 random(5);
    std::vector<std::uint32_t> place(soup.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random() % i]);
    TriangleSoup shuffled = soup;
    for (std::size_t v = 0; v < place.size(); ++v) shuffled.positions[place[v]] = soup.positions[v];
    for (Triangle& t : shuffled.triangles) t = {place[t[1]], place[t[2]], place[t[0]]};
    std::reverse(shuffled.triangles.begin(), shuffled.triangles.end());
    const auto moved = regions_of(mesh_of(shuffled));
    std::vector<RegionId> after(place.size());
    for (std::size_t v = 0; v < place.size(); ++v) after[v] = moved[place[v]];
    EXPECT_LE(rand_difference(before, after), 0.03);
  }
}

TEST(Stability, ComponentsAreCutAsIfAlone) {
  const TriangleSoup one = shapes::dumbbell(0.06);
  TriangleSoup two = one;
  shapes::append(two, shapes::translated(one, {50, 0, 0}));
  EXPECT_EQ(segment(mesh_of(two).table, two.positions, {}, serial_for()).region_count, 6u);
}

}  // namespace
}  // namespace selvage
