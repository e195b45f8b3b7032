// SPDX-License-Identifier: MIT
#include "server/segment/segment.h"

#include <algorithm>

#include "server/segment/components.h"
#include "server/segment/erosion.h"
#include "server/segment/merge_by_size.h"
#include "server/segment/minima.h"
#include "server/segment/prune_branches.h"

namespace selvage {
namespace {

/// The dissertation's pipeline, Fig. 4.1. Labels, not yet codable.
std::vector<std::uint32_t> classic_labels(const CornerTable& mesh, std::span<const Vec3> positions,
                                          const SegmentOptions& options, std::uint32_t min_region_vertices,
                                          const ParallelFor& parallel) {
  const Components components = find_components(mesh);
  const auto shapes = measure_components(mesh, positions, components);
  const int rings = std::clamp(options.xmr_rings, 1, 5);
  const Features features = extract_features(mesh, positions, components, shapes, rings, parallel);

  PlateauThresholds thresholds = options.thresholds;
  if (options.mode == SegmentMode::Zhang) thresholds.use_distance = false;
  Minima minima = label_minima(mesh, find_plateau(features, thresholds));
  erode_plateau(mesh, minima);
  merge_by_size(mesh, minima.label_of_vertex, minima.count, min_region_vertices);
  if (options.prune_branches) prune_branches(mesh, minima.label_of_vertex);
  return std::move(minima.label_of_vertex);
}

RegulariseOptions with_default_dust(RegulariseOptions options, std::uint32_t min_region_vertices) {
  constexpr std::uint32_t kMaxDustVertices = 256;
  if (options.min_component_vertices == 0) {
    options.min_component_vertices = std::min(min_region_vertices, kMaxDustVertices);
  }
  return options;
}

}  // namespace

Segmentation segment(const CornerTable& mesh, std::span<const Vec3> positions, const SegmentOptions& options,
                     const ParallelFor& parallel) {
  const std::uint32_t min_region_vertices = options.min_region_vertices > 0
                                                ? options.min_region_vertices
                                                : default_merge_threshold(mesh.vertex_count());
  const auto labels = classic_labels(mesh, positions, options, min_region_vertices, parallel);
  return regularise(mesh, labels, with_default_dust(options.regularise, min_region_vertices), positions);
}

}  // namespace selvage
