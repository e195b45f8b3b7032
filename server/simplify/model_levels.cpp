// SPDX-License-Identifier: MIT
#include "server/simplify/model_levels.h"

#include <vector>

#include "server/simplify/level_bounds.h"
#include "server/simplify/level_precision.h"
#include "server/simplify/strips.h"

namespace selvage {
namespace {

/// Of the work that there is, by the clock.
constexpr double kShareOfCollapses = 0.7;

Simplification simplified(const LevelSource& source, std::span<const LevelTarget> targets,
                          const SimplifyProgress& progress) {
  std::vector<Vec3> positions;
  positions.reserve(source.positions.size());
  for (const GridPoint& p : source.positions) positions.push_back(without_low_bits(p, 0));
  return simplify({.mesh = source.mesh,
                   .positions = positions,
                   .region_of_vertex = source.region_of_vertex,
                   .pinned = source.pinned},
                  targets, {}, progress);
}

}  // namespace

LevelledMesh make_model_levels(const LevelSource& source, std::span<const LevelTarget> targets,
                               const ParallelFor& parallel, const SimplifyProgress& progress) {
  const auto report = [&](double done) { return !progress || progress(done); };
  const Simplification simplification =
      simplified(source, targets, [&](double done) { return report(kShareOfCollapses * done); });
  if (!report(kShareOfCollapses)) return {};
  LevelledMesh levels =
      split_by_region(source.mesh, source.region_of_vertex, source.region_count, simplification);
  const std::vector<Strip> strips = find_strips(source.mesh, source.region_of_vertex);
  set_precisions(source, strips, levels);
  bound_levels(source, strips, levels, parallel,
               [&](double done) { return report(kShareOfCollapses + (1 - kShareOfCollapses) * done); });
  return levels;
}

}  // namespace selvage
