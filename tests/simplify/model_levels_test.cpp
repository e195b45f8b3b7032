// SPDX-License-Identifier: MIT
//
// What the levels of a whole model promise, against mixes of them: chosen by hand where bounds are easily
// wrong, and at random.
#include "server/simplify/model_levels.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/mesh/grid.h"
#include "server/segment/regularise.h"
#include "server/simplify/level_precision.h"
#include "server/simplify/near_surface.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/labelled_shapes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

struct GridModel {
  CornerTable table;
  std::vector<GridPoint> positions;
  Segmentation segmentation;

  LevelSource source() const {
    return {table, positions, segmentation.region_of_vertex, segmentation.region_count};
  }
};

GridModel on_grid(const TriangleSoup& soup, std::span<const std::uint32_t> labels, int bits) {
  GridModel model;
  model.table = build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size()));
  const Grid grid = make_grid(soup.positions, bits);
  for (const Vec3& p : soup.positions) model.positions.push_back(grid.quantise(p));
  model.segmentation = regularise(model.table, labels, {.min_piece_triangles = 3}, soup.positions);
  return model;
}

LevelledMesh levels_of(const GridModel& model, const ParallelFor& parallel = serial_for()) {
  std::vector<LevelTarget> targets;
  for (const double ratio : {0.4, 0.15, 0.04})
    targets.push_back({static_cast<std::uint32_t>(ratio * model.table.triangle_count())});
  return make_model_levels(model.source(), targets, parallel);
}

/// What a client has: representatives, at the precision of their levels.
TriangleSoup mix_of(const GridModel& model, const LevelledMesh& levels,
                    const std::vector<std::uint32_t>& level_of_region) {
  TriangleSoup soup;
  const auto& labels = model.segmentation.region_of_vertex;
  soup.triangles = mixed_triangles(model.table, labels, levels, level_of_region);
  for (VertexId v = 0; v < model.positions.size(); ++v) {
    const std::uint32_t level = level_of_region[labels[v]];
    soup.positions.push_back(
        without_low_bits(model.positions[v], levels.regions[level][labels[v]].dropped_bits));
  }
  return soup;
}

/// One-sided, from samples: corners, edges, and points inside.
double sampled_distance(const TriangleSoup& from, const TriangleSoup& to) {
  const NearSurface surface(to.triangles, to.positions);
  std::vector<NearSurface::Open> stack;
  constexpr double kShares[][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0.3, 0.3}};
  double largest = 0;
  for (const auto& [a, b, c] : from.triangles) {
    for (const auto& [u, v] : kShares) {
      const Vec3 p = from.positions[a] + (from.positions[b] - from.positions[a]) * u +
                     (from.positions[c] - from.positions[a]) * v;
      largest = std::max(largest, surface.nearest(p, HUGE_VAL, stack).squared_distance);
    }
  }
  return std::sqrt(largest);
}

/// How many times the promised distance a mix is away.
double distance_over_bound(const GridModel& model, const LevelledMesh& levels, const TriangleSoup& finest,
                           const std::vector<std::uint32_t>& level_of_region) {
  const TriangleSoup mix = mix_of(model, levels, level_of_region);
  double bound = 0;
  for (RegionId region = 1; region <= model.segmentation.region_count; ++region)
    bound = std::max(bound, levels.regions[level_of_region[region]][region].bound);
  const double distance = std::max(sampled_distance(finest, mix), sampled_distance(mix, finest));
  return bound > 0 ? distance / bound : distance > 1e-6 ? HUGE_VAL : 0;
}

// Levels of one height alone say nothing of mixes: where two loops turn together, each is cut short without
// harm against the other one cut short too, and cuts across its bends if that has stayed fine.
TEST(ModelLevels, BoundsHoldInEveryMix) {
  std::mt19937 random(1);
  double nearest_to_bound = 0;
  for (const LabelledShape& shape : labelled_shapes()) {
    const GridModel model = on_grid(shape.soup, cube_labels(shape.soup, shape.cell), 12);
    const LevelledMesh levels = levels_of(model);
    const auto count = static_cast<std::uint32_t>(levels.regions.size());
    std::vector<std::uint32_t> level_of_region(model.segmentation.region_count + 1, 0);
    const TriangleSoup finest = mix_of(model, levels, level_of_region);
    for (int round = 0; round < 12; ++round) {
      // One coarse region among fine ones has only its own bound to speak for the seams.
      const RegionId lonely = 1 + static_cast<RegionId>(random() % model.segmentation.region_count);
      for (RegionId region = 0; region < level_of_region.size(); ++region) {
        level_of_region[region] = round < 6   ? (region == lonely ? 1 + random() % (count - 1) : 0)
                                  : round < 9 ? (random() % 2) * (count - 1)
                                              : random() % count;
      }
      const double share = distance_over_bound(model, levels, finest, level_of_region);
      ASSERT_LE(share, 1 + 1e-9) << shape.name << ", round " << round;
      nearest_to_bound = std::max(nearest_to_bound, share);
    }
  }
  EXPECT_GT(nearest_to_bound, 0.85) << "bounds are useless if they are far above";
}

// The border winds along the ridge of a flat roof. Two straightened loops lie in the slopes; one beside the
// other left fine spans from slope to slope, twice as far from the model as any level of both.
TEST(ModelLevels, SeesWhatAStraightenedLoopCostsBesideAFineOne) {
  TriangleSoup soup = shapes::grid(40, 40);
  std::vector<std::uint32_t> labels;
  for (Vec3& p : soup.positions) {
    const double from_ridge = p.y - 20 - 4 * std::sin(p.x / 5);
    labels.push_back(from_ridge > 0);
    p.z = -std::abs(from_ridge) / 8;
  }
  const GridModel model = on_grid(soup, labels, 14);
  ASSERT_EQ(model.segmentation.region_count, 2u);
  const LevelledMesh levels = levels_of(model);
  const TriangleSoup finest = mix_of(model, levels, {0, 0, 0});
  for (std::uint32_t one = 0; one < 4; ++one) {
    for (std::uint32_t other = 0; other < 4; ++other) {
      EXPECT_LE(distance_over_bound(model, levels, finest, {0, one, other}), 1 + 1e-9)
          << "levels " << one << " and " << other;
    }
  }
}

TEST(ModelLevels, DoNotDependOnThreads) {
  const LabelledShape shape = labelled_shapes().front();
  const GridModel model = on_grid(shape.soup, cube_labels(shape.soup, shape.cell), 12);
  const LevelledMesh one = levels_of(model), other = levels_of(model, threaded_for(4));
  for (std::size_t level = 0; level < one.regions.size(); ++level) {
    for (std::size_t region = 0; region < one.regions[level].size(); ++region) {
      EXPECT_EQ(one.regions[level][region].bound, other.regions[level][region].bound);
      EXPECT_EQ(one.regions[level][region].dropped_bits, other.regions[level][region].dropped_bits);
    }
  }
}

TEST(ModelLevels, StopWhenTold) {
  const LabelledShape shape = labelled_shapes().front();
  const GridModel model = on_grid(shape.soup, cube_labels(shape.soup, shape.cell), 12);
  const LevelTarget target{100};
  int calls = 0;
  double last = 0;
  make_model_levels(model.source(), {&target, 1}, serial_for(), [&](double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
    ++calls;
    return true;
  });
  EXPECT_GT(last, 0.9);
  EXPECT_GT(calls, 10);
  EXPECT_TRUE(make_model_levels(model.source(), {&target, 1}, serial_for(), [](double) {
                return false;
              }).regions.empty());
  for (int stop_at = 1; stop_at < calls; stop_at += 9) {
    int made = 0;
    make_model_levels(model.source(), {&target, 1}, serial_for(), [&](double) { return ++made < stop_at; });
    EXPECT_LE(made, calls);
  }
}

}  // namespace
}  // namespace selvage
