// SPDX-License-Identifier: MIT
#include "bench/simplify/labelled_levels.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>

#include "bench/simplify/metro.h"
#include "bench/simplify/nearest_triangle.h"
#include "common/base/parallel.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"
#include "tests/simplify/simplify_support.h"

namespace selvage::bench {
namespace {

TriangleSoup soup_of(const LabelledMesh& mesh, std::vector<Triangle> triangles) {
  return {mesh.positions, std::move(triangles)};
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

}  // namespace

std::optional<LabelledMesh> load_labelled(const std::string& path, std::uint32_t regions) {
  auto file = read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().to_string().c_str()), std::nullopt;
  auto repaired = repair(file->soup);
  if (!repaired)
    return std::fprintf(stderr, "%s: %s\n", path.c_str(), repaired.error().message.c_str()), std::nullopt;
  RepairedMesh ordered = spatially_ordered(std::move(*repaired));
  LabelledMesh mesh{std::move(ordered.table), std::move(ordered.positions), {}, {}};
  const SegmentOptions options{.target_regions = regions,
                               .max_region_vertices = 3 * mesh.table.vertex_count() / (2 * regions)};
  mesh.segmentation = segment(mesh.table, mesh.positions, options, serial_for());
  mesh.finest = soup_of(mesh, {});
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    mesh.finest.triangles.push_back(mesh.table.triangle(t));
  }
  return mesh;
}

Simplification simplified(const LabelledMesh& mesh, std::span<const RegionId> labels, double& seconds) {
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

MixFigures measure_mixes(const LabelledMesh& mesh, const LevelledMesh& levels, const MixOptions& options) {
  std::mt19937 random(1);
  NearestTriangle finest(mesh.finest);
  const std::uint32_t vertices = mesh.table.vertex_count();
  const Topology topology = topology_of(mesh.finest.triangles, vertices);
  MixFigures figures;
  for (int i = 0; i < options.count; ++i) {
    std::vector<std::uint32_t> level_of_region(mesh.segmentation.region_count + 1);
    for (std::uint32_t& level : level_of_region) level = random() % kLevels;
    if (options.is_smooth) smooth(mesh, level_of_region);
    std::vector<Triangle> mixed =
        mixed_triangles(mesh.table, mesh.segmentation.region_of_vertex, levels, level_of_region);
    const bool is_whole =
        manifold_violation(mixed, vertices).empty() && topology_of(mixed, vertices) == topology;
    figures.broken += !is_whole;
    const double share = reversed_boundary_area(mesh, finest, mixed);
    figures.mean_reversed += share / options.count;
    figures.most_reversed = std::max(figures.most_reversed, share);
    if (i >= options.measured) continue;
    const double distance = surface_distance(mesh.finest, soup_of(mesh, std::move(mixed))).largest;
    figures.largest_distance = std::max(figures.largest_distance, distance);
  }
  return figures;
}

}  // namespace selvage::bench
