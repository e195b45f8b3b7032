// SPDX-License-Identifier: MIT
//
// What do regions cost a simplification, and how good is any mix of levels?
//
//   levels_bench MODEL...                about 60 regions, levels of 50, 25, 12.5 and 6.25 % of the triangles
//   levels_bench --regions 20 MODEL...
//
// For each model: CPU time with and without labels; at each level the two-sided Hausdorff and mean distance
// over those of the same simplifier without labels, and the true Hausdorff distance over the recorded
// deviation. Then 32 random mixes, and 32 where neighbours differ by one level at most: the largest Hausdorff
// distance over that of the coarsest level, and the share of area of boundary triangles that look away from
// the nearest triangle of the finest mesh.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "bench/simplify/metro.h"
#include "bench/simplify/nearest_triangle.h"
#include "common/base/parallel.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/segment.h"
#include "server/simplify/levels.h"
#include "server/simplify/simplify.h"

namespace selvage::bench {
namespace {

constexpr double kRatios[] = {0.5, 0.25, 0.125, 0.0625};
constexpr std::uint32_t kLevels = 5;
constexpr int kMixes = 32;

struct LabelledMesh {
  CornerTable table;
  std::vector<Vec3> positions;
  Segmentation segmentation;
  TriangleSoup finest;
};

TriangleSoup soup_of(const LabelledMesh& mesh, std::vector<Triangle> triangles) {
  return {mesh.positions, std::move(triangles)};
}

Simplification timed_levels(const LabelledMesh& mesh, std::span<const RegionId> labels, double& seconds) {
  std::vector<LevelTarget> targets;
  for (const double ratio : kRatios) {
    targets.push_back({static_cast<std::uint32_t>(ratio * mesh.table.triangle_count())});
  }
  const std::clock_t start = std::clock();
  Simplification run = simplify({mesh.table, mesh.positions, labels}, targets);
  seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return run;
}

TriangleSoup level_of(const LabelledMesh& mesh, const Simplification& run, std::size_t level) {
  const auto representative =
      representatives_after(run.collapses, run.levels[level].collapses, mesh.table.vertex_count());
  return soup_of(mesh, substituted_triangles(mesh.table, representative));
}

/// Lowers levels until neighbours differ by one at most.
void smooth(const LabelledMesh& mesh, std::vector<std::uint32_t>& level_of_region) {
  const auto& region_of_vertex = mesh.segmentation.region_of_vertex;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (CornerId c = 0; c < mesh.table.corner_count(); ++c) {
      const RegionId a = region_of_vertex[mesh.table.vertex(c)],
                     b = region_of_vertex[mesh.table.vertex(next(c))];
      for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
        if (level_of_region[one] <= level_of_region[other] + 1) continue;
        level_of_region[one] = level_of_region[other] + 1;
        has_changed = true;
      }
    }
  }
}

/// Share of the area, in %.
double reversed_boundary_area(const LabelledMesh& mesh, NearestTriangle& finest,
                              const std::vector<Triangle>& triangles) {
  const auto& region_of_vertex = mesh.segmentation.region_of_vertex;
  double all = 0, reversed = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    const Vec3 normal = cross(q - p, r - p);
    all += length(normal);
    if (region_of_vertex[a] == region_of_vertex[b] && region_of_vertex[a] == region_of_vertex[c]) continue;
    if (dot(normal, finest.nearest((p + q + r) * (1.0 / 3)).normal) < 0) reversed += length(normal);
  }
  return 100 * reversed / all;
}

void measure_mixes(const LabelledMesh& mesh, const LevelledMesh& levels, double coarsest, bool is_smooth) {
  std::mt19937 random(1);
  NearestTriangle finest(mesh.finest);
  double largest = 0, reversed = 0, most_reversed = 0;
  for (int i = 0; i < kMixes; ++i) {
    std::vector<std::uint32_t> level_of_region(mesh.segmentation.region_count + 1);
    for (std::uint32_t& level : level_of_region) level = random() % kLevels;
    if (is_smooth) smooth(mesh, level_of_region);
    std::vector<Triangle> mixed =
        mixed_triangles(mesh.table, mesh.segmentation.region_of_vertex, levels, level_of_region);
    const double share = reversed_boundary_area(mesh, finest, mixed);
    reversed += share / kMixes;
    most_reversed = std::max(most_reversed, share);
    if (i % 4 != 0) continue;  // distances take most of the time
    largest = std::max(largest, surface_distance(mesh.finest, soup_of(mesh, std::move(mixed))).largest);
  }
  std::printf(
      "  %s mixes: Hausdorff up to %.3f of the coarsest level's; reversed area %.4f %%, at most %.4f %%\n",
      is_smooth ? "smooth " : "any    ", largest / coarsest, reversed, most_reversed);
}

bool measure(const std::string& path, std::uint32_t regions) {
  auto file = read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().to_string().c_str()), false;
  auto repaired = repair(file->soup);
  if (!repaired)
    return std::fprintf(stderr, "%s: %s\n", path.c_str(), repaired.error().message.c_str()), false;
  RepairedMesh ordered = spatially_ordered(std::move(*repaired));
  LabelledMesh mesh{std::move(ordered.table), std::move(ordered.positions), {}, {}};
  const SegmentOptions options{.target_regions = regions,
                               .max_region_vertices = 3 * mesh.table.vertex_count() / (2 * regions)};
  mesh.segmentation = segment(mesh.table, mesh.positions, options, serial_for());
  mesh.finest = soup_of(mesh, {});
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    mesh.finest.triangles.push_back(mesh.table.triangle(t));
  }

  double labelled_seconds = 0, free_seconds = 0;
  const Simplification labelled = timed_levels(mesh, mesh.segmentation.region_of_vertex, labelled_seconds);
  const Simplification free_run = timed_levels(mesh, {}, free_seconds);
  std::printf("%s: %u triangles, %u regions; CPU %.3f s with labels, %.3f s without\n",
              path.substr(path.find_last_of('/') + 1).c_str(), mesh.table.triangle_count(),
              mesh.segmentation.region_count, labelled_seconds, free_seconds);
  double coarsest = 0;
  for (std::size_t level = 1; level < kLevels; ++level) {
    const SurfaceDistance with = surface_distance(mesh.finest, level_of(mesh, labelled, level));
    const SurfaceDistance without = surface_distance(mesh.finest, level_of(mesh, free_run, level));
    std::printf(
        "  level %zu: %8u triangles; over no labels: Hausdorff %.2f, mean %.2f; over recorded: %.2f\n", level,
        labelled.levels[level].triangles, with.largest / without.largest, with.mean / without.mean,
        with.largest / labelled.levels[level].deviation);
    coarsest = with.largest;
  }
  const LevelledMesh levels = split_by_region(mesh.table, mesh.segmentation.region_of_vertex,
                                              mesh.segmentation.region_count, labelled);
  for (const bool is_smooth : {true, false}) measure_mixes(mesh, levels, coarsest, is_smooth);
  std::fflush(stdout);
  return true;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  std::uint32_t regions = 60;
  int models = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--regions" && i + 1 < argc) {
      regions = static_cast<std::uint32_t>(std::stoul(argv[++i]));
      continue;
    }
    if (!selvage::bench::measure(argv[i], regions)) return 1;
    ++models;
  }
  return models > 0 ? 0 : (std::fprintf(stderr, "usage: levels_bench [--regions N] MODEL...\n"), 2);
}
