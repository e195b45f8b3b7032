// SPDX-License-Identifier: MIT
//
// Levels of detail from the encoder to the stitched mesh: the finest exact, any mix closed and as near as the
// directory says, every byte of a coarser part suspect.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "client/stitch/decode_limits.h"
#include "common/mesh/same_mesh.h"
#include "common/pack/level_choice.h"
#include "server/ingest/ingest.h"
#include "server/simplify/point_triangle.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

constexpr double kRatios[] = {0.4, 0.15};

TriangleSoup scaled(TriangleSoup soup, double by) {
  for (Vec3& p : soup.positions) p = p * by;
  return soup;
}

struct Model {
  TriangleSoup soup;
  std::shared_ptr<const Pack> pack;

  Model(const TriangleSoup& shape, double cell, int bits = 14, bool is_exact = false)
      : soup(shape),
        pack(
            Pack::from_bytes(labelled_pack(soup, cube_labels(soup, cell), bits, is_exact, kRatios)).value()) {
  }
  const Directory& directory() const { return pack->directory(); }
};

std::vector<Model> models() {
  TriangleSoup pieces = shapes::grid_with_holes(24, 24, 4);
  shapes::append(pieces, shapes::tetrahedron());
  std::vector<Model> all;
  all.emplace_back(shapes::torus(24, 60), 1.5);
  all.emplace_back(shapes::sphere(4), 0.8);
  all.emplace_back(shapes::chain_of_tori(3), 2.5);
  all.emplace_back(shapes::open_cylinder(30, 40), 0.9);
  all.emplace_back(pieces, 9);
  all.emplace_back(shapes::mobius_strip(60), 0.8);
  return all;
}

Selection random_mix(const Directory& directory, std::mt19937& random) {
  Selection mix;
  for (RegionId id = 1; id < directory.regions.size(); ++id)
    mix.levels.push_back({id, static_cast<std::uint8_t>(random() % 4)});
  return mix;
}

std::set<std::pair<VertexId, VertexId>> directed_edges(const TriangleSoup& soup, bool& is_sound) {
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const auto& [a, b, c] : soup.triangles) {
    is_sound &= a != b && b != c && c != a;
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      is_sound &= edges.insert(edge).second;
  }
  return edges;
}

std::size_t border_edges(const TriangleSoup& soup, bool& is_sound) {
  const auto edges = directed_edges(soup, is_sound);
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.count({edge.second, edge.first}) == 0;
  }));
}

double distance(const Vec3& p, const TriangleSoup& surface) {
  double least = HUGE_VAL;
  for (const auto& [a, b, c] : surface.triangles) {
    const PreparedTriangle t(surface.positions[a], surface.positions[b], surface.positions[c]);
    least = std::min(least, t.squared_distance(p));
  }
  return std::sqrt(least);
}

TEST(Levels, FinestIsExactBesideCoarserOnes) {
  for (const Model& model : models()) {
    const auto stitched = unpack(*model.pack);
    ASSERT_TRUE(stitched) << stitched.error().message;
    const auto comparison = compare_meshes(model.soup, stitched->soup, model.directory().grid.step / 2);
    EXPECT_TRUE(comparison.same) << comparison.difference;
  }
}

TEST(Levels, EveryRegionHasEveryLevel) {
  for (const Model& model : models()) {
    EXPECT_EQ(model.directory().level_count(), 3u);
    for (RegionId id = 1; id < model.directory().regions.size(); ++id)
      EXPECT_EQ(model.directory().regions[id].levels.size(), 3u);
  }
}

TEST(Levels, CoarserLevelsAreCoarser) {
  const Model model(shapes::torus(48, 120), 3);
  std::vector<std::size_t> triangles;
  for (std::uint8_t level = 0; level < 3; ++level)
    triangles.push_back(unpack(*model.pack, {.level = level})->soup.triangles.size());
  EXPECT_LE(triangles[1], 0.42 * static_cast<double>(triangles[0]));
  EXPECT_LE(triangles[2], 0.2 * static_cast<double>(triangles[0]));
}

// Copies of a vertex are pinned, but fans that were apart may come to share an edge where they meet again; so
// the strip, which is cut, is left out.
TEST(Levels, AnyMixIsClosedWhereTheInputIs) {
  std::mt19937 random(1);
  for (const Model& model : models()) {
    if (model.directory().source.cut_vertices > 0 ||
        model.directory().vertices != model.soup.positions.size())
      continue;
    bool is_manifold = true;
    const std::size_t borders = border_edges(model.soup, is_manifold);
    if (!is_manifold) continue;
    for (int round = 0; round < 60; ++round) {
      const auto stitched = unpack(*model.pack, random_mix(model.directory(), random));
      ASSERT_TRUE(stitched) << stitched.error().message;
      bool is_sound = true;
      EXPECT_LE(border_edges(stitched->soup, is_sound), borders);
      EXPECT_EQ(border_edges(stitched->soup, is_sound) == 0, borders == 0);
      EXPECT_TRUE(is_sound);
    }
  }
}

TEST(Levels, AreAsNearAsTheDirectorySays) {
  for (const Model& model : models()) {
    for (std::uint8_t level : {1, 2}) {
      double bound = 0;
      for (RegionId id = 1; id < model.directory().regions.size(); ++id)
        bound = std::max(bound, level_error(model.directory(), id, level));
      const auto stitched = unpack(*model.pack, {.level = level});
      ASSERT_TRUE(stitched) << stitched.error().message;
      double largest = 0;
      for (std::size_t v = 0; v < model.soup.positions.size(); v += 7)
        largest = std::max(largest, distance(model.soup.positions[v], stitched->soup));
      for (const auto& [a, b, c] : stitched->soup.triangles) {
        const auto& p = stitched->soup.positions;
        largest = std::max(largest, distance((p[a] + p[b] + p[c]) * (1.0 / 3), model.soup));
      }
      EXPECT_LE(largest, bound);
    }
  }
}

TEST(Levels, OfABitExactModelKeepTheFinestExact) {
  const Model model(scaled(shapes::tetrahedron(), 1), 0.4, 10, true);
  EXPECT_TRUE(compare_meshes(model.soup, unpack(*model.pack)->soup, 0).same);
  EXPECT_TRUE(unpack(*model.pack, {.level = 2}));
}

TEST(Levels, ARegionThatCannotShrinkRepeatsItself) {
  const Model model(shapes::tetrahedron(), 100);
  const auto& levels = model.directory().regions.back().levels;
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_TRUE(levels[1].is_repeat && levels[2].is_repeat);
  EXPECT_EQ(unpack(*model.pack, {.level = 2})->soup.triangles.size(), 4u);
}

TEST(Levels, EncodeTheSameOnAnyNumberOfThreads) {
  const TriangleSoup soup = shapes::chain_of_tori(4);
  const IngestOptions options{.segment = {.target_regions = 7}, .levels = usual_levels(4)};
  const auto go_on = [](const std::string&, double) { return true; };
  const auto alone = ingest(soup, options, serial_for(), go_on);
  const auto together = ingest(soup, options, threaded_for(3), go_on);
  ASSERT_TRUE(alone && together);
  EXPECT_EQ(alone->pack, together->pack);
}

/// Of the parts of the second level, over those of the first and the joins.
double share_of_bytes(const IngestedModel& model) {
  const auto pack = Pack::from_bytes(model.pack).value();
  double fine = 0, coarse = 0;
  for (const RegionEntry& region : pack->directory().regions) {
    fine += static_cast<double>(region.bundle.size);
    if (region.levels.empty()) continue;
    fine += static_cast<double>(region.levels[0].part.size);
    if (region.levels.size() > 1 && !region.levels[1].is_repeat)
      coarse += static_cast<double>(region.levels[1].part.size);
  }
  return coarse / fine;
}

// A range map: its regular grid costs next to nothing, and is lost by collapsing.
TEST(Levels, OfTwoTheSecondTakesAQuarterOfTheBytesAtMost) {
  TriangleSoup soup = shapes::grid(90, 90);
  std::mt19937 random(1);
  for (Vec3& p : soup.positions) p.z = 6 * std::sin(p.x / 12) + 0.02 * (random() % 8);
  const auto go_on = [](const std::string&, double) { return true; };
  const auto usual = ingest(soup, {}, serial_for(), go_on);
  const auto asked = ingest(soup, {.levels = {{.ratio = 0.125}}}, serial_for(), go_on);
  ASSERT_TRUE(usual && asked);
  EXPECT_LE(share_of_bytes(*usual), 0.25);
  EXPECT_GT(share_of_bytes(*usual), 0.15);
  EXPECT_GT(share_of_bytes(*asked), 0.26) << "who names a ratio gets it";
  std::set<std::string> stages;
  for (const StageTime& time : usual->times)
    EXPECT_TRUE(stages.insert(time.stage).second) << time.stage << " is listed twice";
}

TEST(Levels, RefusesGoalsThatDoNotGetCoarser) {
  const auto go_on = [](const std::string&, double) { return true; };
  for (const std::vector<LevelGoal>& goals : {std::vector<LevelGoal>{{.ratio = 1.0}},
                                              {{.ratio = 0.1}, {.ratio = 0.2}},
                                              {{.error = 2}, {.error = 1}},
                                              std::vector<LevelGoal>(16, LevelGoal{.ratio = 0.5}),
                                              {{.ratio = std::nan("")}}}) {
    const auto refused = ingest(shapes::sphere(2), {.levels = goals}, serial_for(), go_on);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
  }
}

/// Decodes damaged bytes of a coarser part; what is accepted must be sound.
void expect_sound_or_refused(const Model& model, RegionId id, std::uint8_t level,
                             std::span<const std::byte> bytes) {
  const auto region = decode_region(bytes, decode_limits(model.directory(), id, level));
  if (!region) return;
  ASSERT_TRUE(check_region_mesh(*region));
  ASSERT_EQ(region->vertex_of_boundary.size(), model.directory().regions[id].boundary_vertices());
}

TEST(Levels, CoarserPartsSurviveEveryTruncationAndFlippedBit) {
  const Model model(shapes::torus(16, 40), 1.5);
  for (RegionId id = 1; id < 6 && id < model.directory().regions.size(); ++id) {
    const LevelEntry& entry = model.directory().regions[id].levels[1];
    if (entry.is_repeat) continue;
    const auto part = model.pack->part(entry.part);
    for (std::size_t length = 0; length < part.size(); ++length) {
      const Bytes truncated(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(length));
      expect_sound_or_refused(model, id, 1, truncated);
    }
    Bytes damaged(part.begin(), part.end());
    for (std::size_t bit = 0; bit < 8 * damaged.size(); ++bit) {
      damaged[bit / 8] ^= std::byte{1} << (bit % 8);
      expect_sound_or_refused(model, id, 1, damaged);
      damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    }
    // Neither level passes for another.
    EXPECT_FALSE(decode_region(part, decode_limits(model.directory(), id, 0)));
  }
}

}  // namespace
}  // namespace selvage
