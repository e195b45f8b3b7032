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
#include <cstdio>
#include <string>

#include "bench/simplify/labelled_levels.h"
#include "bench/simplify/metro.h"

namespace selvage::bench {
namespace {

bool measure(const std::string& path, std::uint32_t regions) {
  const auto loaded = load_labelled(path, regions);
  if (!loaded) return false;
  const LabelledMesh& mesh = *loaded;
  double labelled_seconds = 0, free_seconds = 0;
  const Simplification labelled = simplified(mesh, mesh.segmentation.region_of_vertex, labelled_seconds);
  const Simplification free_run = simplified(mesh, {}, free_seconds);
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
  for (const bool is_smooth : {true, false}) {
    const MixFigures mixes =
        measure_mixes(mesh, levels, {.count = 32, .measured = 8, .is_smooth = is_smooth});
    std::printf(
        "  %s mixes: Hausdorff up to %.3f of the coarsest level's; reversed area %.4f %%, at most %.4f %%\n",
        is_smooth ? "smooth " : "any    ", mixes.largest_distance / coarsest, mixes.mean_reversed,
        mixes.most_reversed);
  }
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
