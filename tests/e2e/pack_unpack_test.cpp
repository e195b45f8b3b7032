// SPDX-License-Identifier: MIT
//
// Ingest and client together, without a network: nothing may be lost.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "server/ingest/ingest.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

bool keep_going(const std::string&, double) { return true; }

std::shared_ptr<const Pack> pack_of(const TriangleSoup& soup, const IngestOptions& options = {}) {
  auto model = ingest(soup, options, serial_for(), keep_going);
  EXPECT_TRUE(model) << model.error().message;
  auto pack = Pack::from_bytes(std::move(model->pack));
  EXPECT_TRUE(pack) << pack.error().message;
  return *pack;
}

void expect_restored(const TriangleSoup& soup, const IngestOptions& options = {}) {
  const auto pack = pack_of(soup, options);
  const auto stitched = unpack(*pack);
  ASSERT_TRUE(stitched) << stitched.error().message;
  const MeshComparison comparison = compare_meshes(soup, stitched->soup, pack->directory().grid.step / 2);
  EXPECT_TRUE(comparison.same) << comparison.difference;
  EXPECT_EQ(stitched->soup.triangles.size(), pack->directory().triangles);
  EXPECT_EQ(stitched->soup.positions.size(), pack->directory().vertices);
}

/// Triangles over few vertices: every kind of non-manifold spot, duplicates, repeated indices.
TriangleSoup random_soup(std::uint32_t seed) {
  std::mt19937 random(seed);
  TriangleSoup soup;
  const std::uint32_t vertices = 4 + random() % 12;
  for (std::uint32_t v = 0; v < vertices; ++v)
    soup.positions.push_back({double(random() % 64), double(random() % 64), double(random() % 64)});
  for (int t = 0, count = 1 + static_cast<int>(random() % 40); t < count; ++t) {
    soup.triangles.push_back({static_cast<std::uint32_t>(random() % vertices),
                              static_cast<std::uint32_t>(random() % vertices),
                              static_cast<std::uint32_t>(random() % vertices)});
  }
  soup.triangles.push_back({0, 1, 2});
  return soup;
}

TEST(PackUnpack, RestoresHandMadeShapes) {
  for (const TriangleSoup& soup :
       {shapes::triangle(), shapes::tetrahedron(), shapes::grid_with_holes(30, 30, 5), shapes::torus(20, 60),
        shapes::sphere(5), shapes::open_cylinder(30, 40), shapes::chain_of_tori(8),
        shapes::mobius_strip(30)}) {
    SCOPED_TRACE(soup.triangles.size());
    expect_restored(soup);
  }
}

TEST(PackUnpack, RestoresSoupsOfEveryDefect) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    // A fine grid, so that no two vertices fall together and the comparison cannot confuse them.
    expect_restored(random_soup(seed), {.bits = 20});
    if (HasFailure()) return;
  }
}

TEST(PackUnpack, DoesNotDependOnTheNumberOfThreads) {
  const TriangleSoup soup = shapes::torus(40, 90);
  const auto one = ingest(soup, {.name = "torus"}, serial_for(), keep_going);
  const auto three = ingest(soup, {.name = "torus"}, threaded_for(3), keep_going);
  EXPECT_EQ(one->pack, three->pack);
}

TEST(PackUnpack, RestoresAnyLabelling) {
  std::mt19937 random(5);
  for (const TriangleSoup& soup : {shapes::torus(20, 60), shapes::sphere(4),
                                   shapes::grid_with_holes(20, 20, 4), shapes::mobius_strip(40)}) {
    for (std::uint32_t labels : {2u, 5u, 1000u}) {
      std::vector<std::uint32_t> label_of_vertex;
      for (std::size_t v = 0; v < soup.positions.size(); ++v) label_of_vertex.push_back(random() % labels);
      const auto pack = Pack::from_bytes(labelled_pack(soup, label_of_vertex, 14)).value();
      const auto stitched = unpack(*pack);
      ASSERT_TRUE(stitched) << stitched.error().message;
      const MeshComparison comparison = compare_meshes(soup, stitched->soup, pack->directory().grid.step / 2);
      EXPECT_TRUE(comparison.same) << comparison.difference;
    }
  }
}

/// The triangles of the whole that lie between the given regions, which is what a selection with joins must
/// give.
TEST(PackUnpack, GivesExactlyTheTrianglesBetweenSelectedRegions) {
  const TriangleSoup soup = shapes::torus(30, 90);
  const auto pack = Pack::from_bytes(labelled_pack(soup, cube_labels(soup, 1.3), 16)).value();
  const Directory& directory = pack->directory();
  ASSERT_GT(directory.real_region_count(), 10u);
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    Selection selection{.kind = Selection::Kind::Ids};
    for (RegionId id = 1; id <= directory.real_region_count(); ++id) {
      if (random() % 2 == 0) selection.ids.push_back(id);
    }
    const auto stitched = unpack(*pack, selection);
    ASSERT_TRUE(stitched) << stitched.error().message;
    // A vertex of the stitched part names its counterpart in the input, as no two of the input fall together.
    std::map<std::array<std::int32_t, 3>, VertexId> input_vertex;
    const auto key = [&](const Vec3& p) {
      const GridPoint g = directory.grid.quantise(p);
      return std::array{g.x, g.y, g.z};
    };
    for (VertexId v = 0; v < soup.positions.size(); ++v) input_vertex[key(soup.positions[v])] = v;
    ASSERT_EQ(input_vertex.size(), soup.positions.size());
    std::vector<bool> is_selected(soup.positions.size(), false);
    for (const Vec3& p : stitched->soup.positions) is_selected[input_vertex.at(key(p))] = true;
    std::size_t expected = 0;
    for (const auto& [a, b, c] : soup.triangles)
      expected += is_selected[a] && is_selected[b] && is_selected[c];
    EXPECT_EQ(stitched->soup.triangles.size(), expected);
  }
}

TEST(PackUnpack, KeepsFloatsBitForBitWhenAskedTo) {
  TriangleSoup soup = shapes::torus(30, 40);
  for (Vec3& p : soup.positions)
    p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  soup.positions[7].x = -0.0;
  soup.positions[8].y = 1e-42f;
  const auto pack = pack_of(soup, {.bits = 10, .lossless = true});
  EXPECT_TRUE(pack->directory().is_exact);
  const auto stitched = unpack(*pack);
  ASSERT_TRUE(stitched) << stitched.error().message;
  const MeshComparison comparison = compare_meshes(soup, stitched->soup, 0);
  EXPECT_TRUE(comparison.same) << comparison.difference;
  const auto is_minus_zero = [](const Vec3& p) { return p.x == 0 && std::signbit(p.x); };
  EXPECT_TRUE(std::any_of(stitched->soup.positions.begin(), stitched->soup.positions.end(), is_minus_zero));
}

TEST(PackUnpack, RefusesToKeepWhatNoFloatHolds) {
  TriangleSoup soup = shapes::torus(10, 10);
  soup.positions[3].z = 0.1;
  const auto model = ingest(soup, {.lossless = true}, serial_for(), keep_going);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::InvalidArgument);
}

TEST(PackUnpack, RefusesTextsThatNoReaderTakes) {
  const std::string longest(4096, 'n'), longer(4097, 'n');
  const TriangleSoup soup = shapes::torus(10, 10);
  EXPECT_TRUE(unpack(*pack_of(soup, {.name = longest, .metadata = {{longest, longest}}})));
  for (const IngestOptions& options :
       {IngestOptions{.name = longer}, IngestOptions{.units = longer},
        IngestOptions{.metadata = {{longer, "value"}}}, IngestOptions{.metadata = {{"key", longer}}}}) {
    const auto model = ingest(soup, options, serial_for(), keep_going);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(model.error().message.find("4097 bytes"), std::string::npos);
  }
}

TEST(PackUnpack, StopsWhenToldTo) {
  const auto model = ingest(shapes::torus(20, 20), {}, serial_for(),
                            [](const std::string& stage, double) { return stage != "segment"; });
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace selvage
