// SPDX-License-Identifier: MIT
#include "server/segment/classic.h"

#include <algorithm>
#include <utility>

#include "server/segment/components.h"
#include "server/segment/erosion.h"
#include "server/segment/merge_by_depth.h"
#include "server/segment/merge_by_size.h"
#include "server/segment/minima.h"
#include "server/segment/prune_branches.h"

namespace selvage {
namespace {

Features features_of(const CornerTable& mesh, std::span<const Vec3> positions, int xmr_rings,
                     const ParallelFor& parallel) {
  const Components components = find_components(mesh);
  const auto shapes = measure_components(mesh, positions, components);
  return extract_features(mesh, positions, components, shapes, std::clamp(xmr_rings, 1, 5), parallel);
}

Minima basins_of(const CornerTable& mesh, const Features& features, const PlateauThresholds& thresholds) {
  const Neighbours neighbours(mesh);
  Minima basins = label_minima(neighbours, find_plateau(features, thresholds));
  erode_plateau(neighbours, basins);
  return basins;
}

std::vector<double> heights_of(const Features& features) {
  std::vector<double> height = features.distance;
  for (double& h : height) h = -h;
  return height;
}

}  // namespace

std::vector<std::uint32_t> classic_labels(const CornerTable& mesh, std::span<const Vec3> positions,
                                          const ClassicOptions& options, std::uint32_t min_region_vertices,
                                          const ParallelFor& parallel) {
  const Features features = features_of(mesh, positions, options.xmr_rings, parallel);
  Minima basins = basins_of(mesh, features, options.thresholds);
  merge_by_size(mesh, basins.label_of_vertex, basins.count, min_region_vertices);
  if (options.prune_branches) prune_branches(mesh, basins.label_of_vertex);
  return std::move(basins.label_of_vertex);
}

std::vector<std::uint32_t> mangan_whitaker_labels(const CornerTable& mesh, std::span<const Vec3> positions,
                                                  const ClassicOptions& options,
                                                  std::uint32_t min_region_vertices,
                                                  std::uint32_t target_regions, const ParallelFor& parallel) {
  const Features features = features_of(mesh, positions, options.xmr_rings, parallel);
  Minima basins = basins_of(mesh, features, options.thresholds);
  if (target_regions == 0) {
    std::vector<std::uint32_t> merged = basins.label_of_vertex;
    target_regions = merge_by_size(mesh, merged, basins.count, min_region_vertices);
  }
  merge_by_depth(mesh, heights_of(features), basins, target_regions);
  if (options.prune_branches) prune_branches(mesh, basins.label_of_vertex);
  return std::move(basins.label_of_vertex);
}

}  // namespace selvage
