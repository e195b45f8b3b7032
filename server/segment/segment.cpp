// SPDX-License-Identifier: MIT
#include "server/segment/segment.h"

#include <algorithm>

#include "common/base/ids.h"
#include "server/segment/merge_by_size.h"

namespace selvage {
namespace {

ClassicOptions classic_options(const SegmentOptions& options) {
  ClassicOptions classic{options.xmr_rings, options.thresholds, options.prune_branches};
  if (options.mode == SegmentMode::Zhang) classic.thresholds.use_distance = false;
  return classic;
}

std::uint32_t merge_threshold(const SegmentOptions& options, std::uint32_t vertex_count) {
  return options.min_region_vertices > 0 ? options.min_region_vertices
                                         : default_merge_threshold(vertex_count);
}

RegulariseOptions regularise_options(const SegmentOptions& options, std::uint32_t vertex_count) {
  constexpr std::uint32_t kMaxDustVertices = 256;
  RegulariseOptions regularise = options.regularise;
  if (regularise.min_component_vertices == 0) {
    regularise.min_component_vertices = std::min(merge_threshold(options, vertex_count), kMaxDustVertices);
  }
  return regularise;
}

std::vector<std::uint32_t> label_vertices(const CornerTable& mesh, std::span<const Vec3> positions,
                                          const SegmentOptions& options, const ParallelFor& parallel) {
  const std::uint32_t threshold = merge_threshold(options, mesh.vertex_count());
  switch (options.mode) {
    case SegmentMode::Classic:
    case SegmentMode::Zhang:
      return classic_labels(mesh, positions, classic_options(options), threshold, parallel);
    case SegmentMode::ManganWhitaker:
      return mangan_whitaker_labels(mesh, positions, classic_options(options), threshold,
                                    options.target_regions, parallel);
    case SegmentMode::Xmrg:
    case SegmentMode::Cad:
      break;
  }
  const XmrgOptions xmrg = xmrg_options(options);
  const Neighbours neighbours(mesh);
  return xmrg_labels(neighbours, grow_xmrg_hierarchy(mesh, neighbours, positions, xmrg, parallel), xmrg);
}

}  // namespace

SegmentOptions with_streaming_sizes(SegmentOptions options, std::uint32_t triangle_count) {
  constexpr std::uint32_t kSmallModel = 20000, kMinVertices = 384, kMaxVertices = 4096;
  const bool has_sizes = options.mode == SegmentMode::Xmrg || options.mode == SegmentMode::Cad;
  if (triangle_count <= kSmallModel || !has_sizes || options.target_regions > 0) return options;
  std::uint32_t& least = options.min_region_vertices;
  std::uint32_t& most = options.max_region_vertices;
  if (least == 0) least = most == 0 ? kMinVertices : std::min(kMinVertices, std::max(1u, most / 4));
  constexpr double kStopSaliency = 0.2;  // a little above the default: fewer borders, which cost bytes
  options.stop_saliency = std::max(options.stop_saliency, kStopSaliency);
  options.smooth = true;
  if (most == 0) most = std::max(kMaxVertices, least <= kNone / 4 ? 4 * least : kNone);
  return options;
}

XmrgOptions xmrg_options(const SegmentOptions& options) {
  XmrgOptions xmrg{options.height,        options.basins,         options.hierarchy,
                   options.stop_saliency, options.target_regions, options.smooth};
  if (options.mode == SegmentMode::Cad) {
    // A cylinder bends all over, with height -0.5 radius / R; a ridge of 17 degrees is as high as one of R
    // = 3.3 radii.
    constexpr double kRidgeDepth = 0.15;
    xmrg.height.cut_at_ridges = true;
    xmrg.basins.plateau_depth = std::max(xmrg.basins.plateau_depth, kRidgeDepth);
  }
  xmrg.hierarchy.min_region_vertices = options.min_region_vertices;
  xmrg.hierarchy.max_region_vertices = options.max_region_vertices;
  return xmrg;
}

Segmentation segment(const CornerTable& mesh, std::span<const Vec3> positions, const SegmentOptions& options,
                     const ParallelFor& parallel) {
  const std::vector<std::uint32_t> labels = label_vertices(mesh, positions, options, parallel);
  return regularise(mesh, labels, regularise_options(options, mesh.vertex_count()), positions);
}

}  // namespace selvage
