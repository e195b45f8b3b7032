// SPDX-License-Identifier: MIT
//
// Any mix of levels, in any order of coming and going, against the definition of the mix (levels.h) and
// against the topology of the model.
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "client/stitch/stitcher.h"
#include "tests/simplify/simplify_support.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/labelled_shapes.h"
#include "tests/support/levelled_model.h"
#include "tests/support/mesh_mirror.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr double kRatios[] = {0.5, 0.25, 0.125, 0.0625, 0.0};

LevelledModel model_of(std::string name, const TriangleSoup& soup, double cell) {
  RepairedMesh mesh = repair(soup).value();
  const auto labels = cube_labels({mesh.positions, {}}, cell);
  return levelled_model(std::move(name), std::move(mesh), labels, kRatios);
}

/// Whose triangles are an oriented manifold by the file's own indices.
std::vector<LevelledModel> manifold_models() {
  std::vector<LevelledModel> all;
  for (const LabelledShape& shape : labelled_shapes())
    all.push_back(model_of(shape.name, shape.soup, shape.cell));
  return all;
}

/// What repair has to cut: copies in several regions that are one vertex, turned triangles, scraps.
std::vector<LevelledModel> ragged_models() {
  std::vector<LevelledModel> all;
  std::mt19937 random(7);
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const RandomManifold mesh = random_manifold(seed);
    TriangleSoup soup{mesh.positions, {}};
    for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t)
      soup.triangles.push_back(mesh.table.triangle(t));
    const auto any_vertex = [&] { return static_cast<VertexId>(random() % soup.positions.size()); };
    for (int i = 0; i < 12; ++i) {
      const Triangle extra = {any_vertex(), any_vertex(), any_vertex()};
      if (extra[0] != extra[1] && extra[1] != extra[2] && extra[2] != extra[0])
        soup.triangles.push_back(extra);
    }
    for (int i = 0; i < 12; ++i) {
      Triangle& triangle = soup.triangles[random() % soup.triangles.size()];
      std::swap(triangle[0], triangle[1]);
    }
    all.push_back(model_of("ragged " + std::to_string(seed), soup, 1.5));
  }
  return all;
}

std::vector<std::uint32_t> random_levels(const LevelledModel& model, int round, std::mt19937& random) {
  std::vector<std::uint32_t> levels(model.region_count() + 1, 0);
  const std::uint32_t coarsest = model.level_count() - 1;
  for (RegionId id = 1; id < levels.size(); ++id) {
    // At first the extremes, where tests of neighbours at the same level would not tell.
    levels[id] = round < 4 ? coarsest * (random() % 2) : random() % model.level_count();
  }
  return levels;
}

Stitcher stitched(const LevelledModel& model, const std::vector<std::uint32_t>& level_of_region) {
  Stitcher stitcher(model.directory);
  for (RegionId id = 0; id < level_of_region.size(); ++id) {
    EXPECT_TRUE(stitcher.add_bundle(id, model.bundles[id]));
    if (level_of_region[id] == kAbsent) continue;
    const std::uint32_t level = level_of_region[id];
    EXPECT_TRUE(stitcher.add_region(id, model.region(id, level), static_cast<std::uint8_t>(level)));
  }
  return stitcher;
}

VertexId source_at(const Vec3& position) { return static_cast<VertexId>(position.x); }

/// In the file's vertices; fails if two vertices are one of the file's.
std::vector<Triangle> in_file_vertices(const TriangleSoup& soup) {
  std::set<VertexId> seen;
  for (const Vec3& p : soup.positions)
    EXPECT_TRUE(seen.insert(source_at(p)).second) << "vertex " << source_at(p) << " twice";
  std::vector<Triangle> triangles = soup.triangles;
  for (Triangle& triangle : triangles) {
    for (VertexId& v : triangle) v = source_at(soup.positions[v]);
  }
  return in_canonical_order(std::move(triangles));
}

TEST(MixedLevels, AreTheFinestMeshInItsRepresentativesAndKeepItsTopology) {
  std::mt19937 random(1);
  for (const LevelledModel& model : manifold_models()) {
    const std::vector<std::uint32_t> finest(model.region_count() + 1, 0);
    const auto vertices = static_cast<std::uint32_t>(model.mesh.positions.size());
    const std::vector<Triangle> input = model.mix(finest);
    const Topology expected = topology_of(input, vertices);
    std::set<VertexId> on_border;
    for (const auto& [a, b] : border_edges(input)) on_border.insert({a, b});
    for (int round = 0; round < 24; ++round) {
      const auto levels = random_levels(model, round, random);
      const auto triangles = in_file_vertices(stitched(model, levels).mesh().soup);
      ASSERT_EQ(triangles, model.mix(levels)) << model.name << ", round " << round;
      ASSERT_EQ(manifold_violation(triangles, vertices), "") << model.name << ", round " << round;
      ASSERT_EQ(topology_of(triangles, vertices), expected) << model.name << ", round " << round;
      for (const auto& [a, b] : border_edges(triangles)) {
        ASSERT_TRUE(on_border.contains(a) && on_border.contains(b)) << model.name << ": a crack";
      }
    }
  }
}

/// Edges with an odd number of triangles.
std::set<std::pair<VertexId, VertexId>> odd_edges(const std::vector<Triangle>& triangles) {
  std::set<std::pair<VertexId, VertexId>> odd;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
      if (!odd.erase({edge.first, edge.second})) odd.insert({edge.first, edge.second});
    }
  }
  return odd;
}

TEST(MixedLevels, OfRaggedMeshesAreWeldedAndOpenOnlyAtTheBordersOfTheInput) {
  std::mt19937 random(2);
  for (const LevelledModel& model : ragged_models()) {
    std::set<VertexId> may_be_open;
    for (CornerId c = 0; c < model.mesh.table.corner_count(); ++c) {
      if (model.mesh.table.opposite[c] != kNone) continue;
      for (const CornerId end : {next(c), prev(c)})
        may_be_open.insert(model.mesh.source_of_vertex[model.mesh.table.vertex(end)]);
    }
    for (int round = 0; round < 12; ++round) {
      const auto levels = random_levels(model, round, random);
      const auto triangles = in_file_vertices(stitched(model, levels).mesh().soup);
      ASSERT_EQ(triangles, model.mix(levels)) << model.name << ", round " << round;
      for (const auto& [a, b] : odd_edges(triangles)) {
        ASSERT_TRUE(may_be_open.contains(a) && may_be_open.contains(b)) << model.name << ": a crack";
      }
    }
  }
}

TEST(MixedLevels, TheFinestIsTheFile) {
  for (const auto& models : {manifold_models(), ragged_models()}) {
    for (const LevelledModel& model : models) {
      std::vector<Triangle> file;
      for (TriangleId t = 0; t < model.mesh.table.triangle_count(); ++t) {
        Triangle triangle = model.mesh.table.triangle(t);
        for (VertexId& v : triangle) v = model.mesh.source_of_vertex[v];
        if (model.mesh.is_turned[t]) std::swap(triangle[1], triangle[2]);
        file.push_back(triangle);
      }
      const std::vector<std::uint32_t> finest(model.region_count() + 1, 0);
      EXPECT_EQ(in_file_vertices(stitched(model, finest).mesh().soup), in_canonical_order(std::move(file)))
          << model.name;
    }
  }
}

/// Regions come, go and change their level in random order, bundles come in between; after every step the
/// mirror, the stitcher and one that was built afresh hold the same mesh, which is the mix.
void change_at_random(const LevelledModel& model, int steps, std::mt19937& random) {
  Stitcher stitcher(model.directory);
  MeshMirror mirror;
  std::vector<std::uint32_t> levels(model.region_count() + 1, kAbsent);
  for (RegionId id = 0; id < levels.size(); ++id) ASSERT_TRUE(stitcher.add_bundle(id, model.bundles[id]));
  for (int step = 0; step < steps; ++step) {
    for (std::uint32_t change = 0; change <= random() % 3; ++change) {
      const RegionId id = random() % static_cast<RegionId>(levels.size());
      if (random() % 4 == 0) {
        stitcher.remove_region(id);
        levels[id] = kAbsent;
        continue;
      }
      levels[id] = id == kLooseRegion ? 0 : random() % model.level_count();
      ASSERT_TRUE(
          stitcher.add_region(id, model.region(id, levels[id]), static_cast<std::uint8_t>(levels[id])));
      if (random() % 8 == 0) {
        ASSERT_TRUE(stitcher.add_bundle(id, model.bundles[id]));
      }
    }
    mirror.apply(stitcher.take_update());
    const StitchedMesh mesh = stitcher.mesh();
    const StitchedMesh fresh = stitched(model, levels).mesh();
    ASSERT_EQ(mesh.soup.triangles, fresh.soup.triangles) << model.name << ", step " << step;
    ASSERT_EQ(mesh.region_of_vertex, fresh.region_of_vertex) << model.name << ", step " << step;
    const auto triangles = in_file_vertices(mesh.soup);
    ASSERT_EQ(triangles, model.mix(levels)) << model.name << ", step " << step;
    ASSERT_EQ(in_file_vertices(mirror.soup()), triangles) << model.name << ", step " << step;
    ASSERT_EQ(mirror.soup().positions.size(), mesh.soup.positions.size()) << model.name << ", step " << step;
  }
}

TEST(MixedLevels, StayThemselvesThroughEveryChange) {
  std::mt19937 random(3);
  for (const LevelledModel& model : manifold_models()) change_at_random(model, 30, random);
  for (const LevelledModel& model : ragged_models()) change_at_random(model, 30, random);
}

TEST(MixedLevels, StayClosedWhileEveryRegionIsRefinedInTurn) {
  const LevelledModel model = model_of("torus", shapes::torus(30, 90), 1.1);
  std::vector<std::uint32_t> levels(model.region_count() + 1, model.level_count() - 1);
  levels[kLooseRegion] = 0;
  Stitcher stitcher = stitched(model, levels);
  const auto vertices = static_cast<std::uint32_t>(model.mesh.positions.size());
  for (RegionId id = 1; id <= model.region_count(); ++id) {
    for (std::uint32_t level = model.level_count(); level-- > 0;) {
      ASSERT_TRUE(stitcher.add_region(id, model.region(id, level), static_cast<std::uint8_t>(level)));
      const auto triangles = in_file_vertices(stitcher.mesh().soup);
      ASSERT_EQ(manifold_violation(triangles, vertices), "");
      ASSERT_TRUE(border_edges(triangles).empty());
    }
  }
  EXPECT_EQ(stitcher.mesh().soup.triangles.size(), model.mesh.table.triangle_count());
}

// Fig. 3.17 and 3.18: what is thin or open does not close up, fall off or vanish.
TEST(MixedLevels, OfTheDissertationsSpecialCasesKeepTheirFeatures) {
  for (const auto& model :
       {model_of("lamp", lamp(48), 6), model_of("box with handle", box_with_handle(), 13)}) {
    std::vector<std::uint32_t> levels(model.region_count() + 1, 0);
    const std::vector<Triangle> finest = model.mix(levels);
    std::fill(levels.begin() + 1, levels.end(), 3);  // an eighth
    const auto vertices = static_cast<std::uint32_t>(model.mesh.positions.size());
    const auto coarse = in_file_vertices(stitched(model, levels).mesh().soup);
    EXPECT_LT(coarse.size() * 6, finest.size()) << model.name;
    EXPECT_EQ(topology_of(coarse, vertices), topology_of(finest, vertices)) << model.name;
    std::vector<Vec3> position_in_file(vertices);
    for (VertexId v = 0; v < vertices; ++v)
      position_in_file[model.mesh.source_of_vertex[v]] = model.mesh.positions[v];
    const double error = farthest_from(position_in_file, coarse, position_in_file);
    EXPECT_LT(error, 0.25) << model.name;  // the handle is 1 thick, the shade 3 to 10 wide, the pole 0.5
  }
}

/// What changing one region costs.
std::uint64_t cost_of_refining(const LevelledModel& model, RegionId id) {
  std::vector<std::uint32_t> levels(model.region_count() + 1, 1);
  levels[kLooseRegion] = 0;
  Stitcher stitcher = stitched(model, levels);
  stitcher.take_update();
  const std::uint64_t before = stitcher.elements_visited();
  EXPECT_TRUE(stitcher.add_region(id, model.region(id, 0), 0));
  stitcher.take_update();
  return stitcher.elements_visited() - before;
}

TEST(MixedLevels, RefiningARegionLooksAtItAndItsJoinsOnly) {
  for (const int side : {40, 160}) {
    // Regions of 10 x 10 cells; the model of the second round is 16 times the first.
    const LevelledModel model = model_of("grid", shapes::grid(side, side), 10);
    const RegionId id = model.region_count() / 2;
    std::uint64_t joins = 0;
    for (const auto& bundle : model.bundles) {
      for (const BoundaryTriangle& triangle : bundle) {
        joins += std::any_of(triangle.corners.begin(), triangle.corners.end(),
                             [&](const BoundaryRef& corner) { return corner.region == id; });
      }
    }
    const std::uint64_t old_vertices = model.levels.regions[1][id].vertices.size();
    const std::uint64_t new_vertices = model.levels.regions[0][id].vertices.size();
    const std::uint64_t new_triangles = model.levels.regions[0][id].triangles.size();
    // Old vertices go and are reported, new ones come and are reported.
    EXPECT_EQ(cost_of_refining(model, id), 2 * old_vertices + 2 * new_vertices + new_triangles + joins);
    EXPECT_LT(cost_of_refining(model, id), 800u);
  }
}

TEST(MixedLevels, UpdatesListWhatChangedAndNothingElse) {
  const LevelledModel model = model_of("torus", shapes::torus(30, 90), 1.1);
  std::vector<std::uint32_t> levels(model.region_count() + 1, 1);
  levels[kLooseRegion] = 0;
  Stitcher stitcher = stitched(model, levels);
  stitcher.take_update();
  EXPECT_TRUE(stitcher.take_update().patches.empty());
  ASSERT_TRUE(stitcher.add_region(5, model.region(5, 0), 0));
  const StitchUpdate update = stitcher.take_update();
  EXPECT_FALSE(update.patches.empty());
  for (const auto& patch : update.patches) {
    const auto& regions = patch.id.regions;
    EXPECT_TRUE(std::find(regions.begin(), regions.end(), 5u) != regions.end());
  }
  for (const auto& vertex : update.vertices) EXPECT_EQ(vertex.region, 5u);
}

/// Two regions with one copy each of a vertex, at levels of different precision.
TEST(MixedLevels, AVertexOfSeveralRegionsTakesItsPlaceFromTheFinestOfThem) {
  Directory directory;
  directory.regions.resize(3);
  for (RegionId id : {1u, 2u}) directory.regions[id].loop_lengths = {3};
  const auto region = [](std::int32_t x) {
    RegionMesh mesh;
    mesh.triangles = {{0, 1, 2}};
    mesh.positions = {{x, 0, 0}, {x, 1, 0}, {x, 2, 0}};
    mesh.anchors = {{0, 9}};
    mesh.loops = {{0, 1, 2}, {3}};
    mesh.vertex_of_boundary = mesh.loops.vertices;
    return mesh;
  };
  const auto shared_x = [](const Stitcher& stitcher) { return stitcher.mesh().soup.positions[0].x; };
  Stitcher stitcher(directory);
  ASSERT_TRUE(stitcher.add_region(1, region(10), 1));
  EXPECT_EQ(shared_x(stitcher), 10);
  ASSERT_TRUE(stitcher.add_region(2, region(20), 0));
  EXPECT_EQ(shared_x(stitcher), 20);
  EXPECT_EQ(stitcher.mesh().soup.positions.size(), 5u);
  stitcher.take_update();
  stitcher.remove_region(2);
  const StitchUpdate update = stitcher.take_update();
  ASSERT_EQ(update.vertices.size(), 1u);  // it moves, although region 1 has not changed
  EXPECT_EQ(update.vertices[0].position.x, 10);
  EXPECT_EQ(update.removed_vertices.size(), 2u);
}

}  // namespace
}  // namespace selvage
