// SPDX-License-Identifier: MIT
#include "server/segment/segment_parts.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/base/disjoint_sets.h"
#include "server/segment/components.h"
#include "server/segment/cut_large.h"

namespace selvage {
namespace {

/// Connected sets of one part each, numbered by first vertex.
Minima connected_parts(const CornerTable& mesh, std::span<const std::uint32_t> part_of_vertex) {
  DisjointSets sets(mesh.vertex_count());
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const VertexId a = mesh.vertex(c), b = mesh.vertex(next(c));
    if (part_of_vertex[a] == part_of_vertex[b]) sets.merge(a, b);
  }
  Minima labels{std::vector<std::uint32_t>(mesh.vertex_count(), kNone), 0};
  std::vector<std::uint32_t> label_of_set(mesh.vertex_count(), kNone);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    std::uint32_t& label = label_of_set[sets.set_of(v)];
    if (label == kNone) label = labels.count++;
    labels.label_of_vertex[v] = label;
  }
  return labels;
}

/// Takes back the cuts in components with a triangle whose vertices are all loose: it would belong to no
/// region. Whether there was any.
bool heal_lost_triangles(const CornerTable& mesh, const Segmentation& segmentation,
                         std::span<const std::uint32_t> uncut, std::vector<std::uint32_t>& labels) {
  const auto is_lost = [&](TriangleId t) {
    const Triangle corners = mesh.triangle(t);
    return std::all_of(corners.begin(), corners.end(),
                       [&](VertexId v) { return segmentation.region_of_vertex[v] == kLooseRegion; });
  };
  const Components components = find_components(mesh);
  std::vector<bool> is_healed(components.count(), false);
  bool is_any = false;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    if (is_lost(t)) is_any = is_healed[components.of_vertex[mesh.vertex(3 * t)]] = true;
  }
  if (!is_any) return false;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (is_healed[components.of_vertex[v]]) labels[v] = uncut[v];
  }
  return true;
}

}  // namespace

Segmentation segment_parts(const CornerTable& mesh, std::span<const Vec3> positions,
                           std::span<const std::uint32_t> part_of_vertex, const PartSizes& sizes) {
  const RegulariseOptions options{.min_component_vertices = sizes.min_component_vertices};
  Minima labels = connected_parts(mesh, part_of_vertex);
  const std::vector<std::uint32_t> uncut = labels.label_of_vertex;
  if (sizes.max_region_vertices > 0) cut_large_regions(Neighbours(mesh), labels, sizes.max_region_vertices);
  Segmentation segmentation = regularise(mesh, labels.label_of_vertex, options, positions, part_of_vertex);
  if (segmentation.loose_vertex_count > 0 &&
      heal_lost_triangles(mesh, segmentation, uncut, labels.label_of_vertex)) {
    segmentation = regularise(mesh, labels.label_of_vertex, options, positions, part_of_vertex);
  }
  return segmentation;
}

std::vector<std::uint32_t> parts_of_regions(const Segmentation& segmentation,
                                            std::span<const std::uint32_t> part_of_vertex) {
  std::vector<std::pair<RegionId, std::uint32_t>> votes;
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v)
    votes.emplace_back(segmentation.region_of_vertex[v], part_of_vertex[v]);
  std::sort(votes.begin(), votes.end());
  std::vector<std::uint32_t> part_of_region(segmentation.region_count + 1, kNone);
  std::vector<std::ptrdiff_t> most(part_of_region.size(), 0);
  for (auto first = votes.begin(); first != votes.end();) {
    const auto last = std::find_if(first, votes.end(), [&](const auto& vote) { return vote != *first; });
    if (first->first != kLooseRegion && last - first > most[first->first]) {
      most[first->first] = last - first;
      part_of_region[first->first] = first->second;
    }
    first = last;
  }
  return part_of_region;
}

}  // namespace selvage
