// SPDX-License-Identifier: MIT
#include "server/segment/xmrg.h"

#include <utility>

#include "server/segment/components.h"
#include "server/segment/cut_large.h"
#include "server/segment/smooth_labels.h"
#include "server/segment/vertex_measures.h"

namespace selvage {

XmrgHierarchy grow_xmrg_hierarchy(const CornerTable& mesh, const Neighbours& neighbours,
                                  std::span<const Vec3> positions, const XmrgOptions& options,
                                  const ParallelFor& parallel) {
  const Components components = find_components(mesh);
  const auto shapes = measure_components(mesh, positions, components);
  const VertexMeasures measures = measure_vertices(mesh, positions);
  HeightField field =
      measure_height(mesh, neighbours, positions, components, shapes, measures, options.height, parallel);
  Minima basins = flood_basins(neighbours, positions, field, options.basins);
  RegionHierarchy regions = build_hierarchy(mesh, positions, components, shapes, measures, field.kappa,
                                            std::move(basins), options.hierarchy);
  return {std::move(field), std::move(regions)};
}

std::vector<std::uint32_t> xmrg_labels(const Neighbours& neighbours, const XmrgHierarchy& hierarchy,
                                       const XmrgOptions& options) {
  const RegionHierarchy& regions = hierarchy.regions;
  const std::size_t merges = options.target_regions > 0 ? regions.merges_until(options.target_regions)
                                                        : regions.merges_below(options.stop_saliency);
  Minima labels = regions.labels_after(merges);
  if (const std::uint32_t largest = options.hierarchy.max_region_vertices; largest > 0) {
    cut_large_regions(neighbours, labels, largest);
  }
  if (options.smooth) smooth_labels(neighbours, hierarchy.field.kappa, labels);
  return std::move(labels.label_of_vertex);
}

}  // namespace selvage
