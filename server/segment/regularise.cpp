// SPDX-License-Identifier: MIT
#include "server/segment/regularise.h"

#include <algorithm>

#include "server/segment/components.h"
#include "server/segment/dissolve.h"
#include "server/segment/group_by_place.h"
#include "server/segment/loosen.h"
#include "server/segment/pieces.h"

namespace selvage {
namespace {

struct DenseLabels {
  std::vector<std::uint32_t> of_vertex;
  std::uint32_t count = 0;
};

DenseLabels make_dense(std::span<const std::uint32_t> label_of_vertex) {
  std::vector<std::uint32_t> values(label_of_vertex.begin(), label_of_vertex.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  DenseLabels labels{std::vector<std::uint32_t>(label_of_vertex.size()),
                     static_cast<std::uint32_t>(values.size())};
  for (std::size_t v = 0; v < label_of_vertex.size(); ++v) {
    const auto at = std::lower_bound(values.begin(), values.end(), label_of_vertex[v]);
    labels.of_vertex[v] = static_cast<std::uint32_t>(at - values.begin());
  }
  return labels;
}

/// Gives every dusty component one label of its own, which neither dissolving nor loosening will touch.
void make_dust_whole(const Components& components, const std::vector<std::uint32_t>& group_of_component,
                     DenseLabels& labels) {
  std::vector<std::uint32_t> label_of_component(components.count(), kNone);
  for (std::uint32_t i = 0; i < components.count(); ++i) {
    if (group_of_component[i] != kNone) label_of_component[i] = labels.count++;
  }
  for (std::size_t v = 0; v < labels.of_vertex.size(); ++v) {
    const std::uint32_t label = label_of_component[components.of_vertex[v]];
    if (label != kNone) labels.of_vertex[v] = label;
  }
}

/// kNone for a component of several parts. Empty if there are no parts.
std::vector<std::uint32_t> parts_of_components(const Components& components,
                                               std::span<const std::uint32_t> part_of_vertex) {
  if (part_of_vertex.empty()) return {};
  std::vector<std::uint32_t> part_of_component(components.count(), kNone);
  std::vector<bool> is_seen(components.count(), false);
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v) {
    const std::uint32_t component = components.of_vertex[v];
    std::uint32_t& part = part_of_component[component];
    if (!is_seen[component]) part = part_of_vertex[v];
    if (part != part_of_vertex[v]) part = kNone;
    is_seen[component] = true;
  }
  return part_of_component;
}

/// The piece that each vertex's only fan belongs to, kNone for vertices without interior triangle.
std::vector<std::uint32_t> pieces_of_vertices(const CornerTable& mesh, const Pieces& pieces) {
  std::vector<std::uint32_t> piece_of_vertex(mesh.vertex_count(), kNone);
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const std::uint32_t piece = pieces.of_triangle[triangle_of(c)];
    if (piece != kNone) piece_of_vertex[mesh.vertex(c)] = piece;
  }
  return piece_of_vertex;
}

/// Pieces become regions, those of one group of dust a common one, numbered by first vertex.
Segmentation number_regions(const std::vector<std::uint32_t>& piece_of_vertex, std::uint32_t piece_count,
                            const Components& components,
                            const std::vector<std::uint32_t>& group_of_component) {
  Segmentation result{std::vector<RegionId>(piece_of_vertex.size(), kLooseRegion), 0, 0};
  std::vector<RegionId> region_of_piece(piece_count, kNone), region_of_group(components.count(), kNone);
  for (std::size_t v = 0; v < piece_of_vertex.size(); ++v) {
    if (piece_of_vertex[v] == kNone) {
      ++result.loose_vertex_count;
      continue;
    }
    const std::uint32_t group = group_of_component[components.of_vertex[v]];
    RegionId& region = group == kNone ? region_of_piece[piece_of_vertex[v]] : region_of_group[group];
    if (region == kNone) region = ++result.region_count;
    result.region_of_vertex[v] = region;
  }
  return result;
}

}  // namespace

Segmentation regularise(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                        const RegulariseOptions& options, std::span<const Vec3> positions,
                        std::span<const std::uint32_t> part_of_vertex) {
  const Components components = find_components(mesh);
  const auto group_of_component = group_by_place(components, positions, options.min_component_vertices,
                                                 parts_of_components(components, part_of_vertex));
  DenseLabels labels = make_dense(label_of_vertex);
  make_dust_whole(components, group_of_component, labels);

  Pieces pieces = find_pieces(mesh, labels.of_vertex, kNone);
  for (int round = 0; round < options.max_rounds; ++round) {
    if (!dissolve_crumbs(mesh, pieces, options.min_piece_triangles, labels.of_vertex, labels.count)) break;
    pieces = find_pieces(mesh, labels.of_vertex, kNone);
  }
  if (loosen_misfits(mesh, labels.of_vertex) > 0) pieces = find_pieces(mesh, labels.of_vertex, kNone);
  return number_regions(pieces_of_vertices(mesh, pieces), pieces.count(), components, group_of_component);
}

}  // namespace selvage
