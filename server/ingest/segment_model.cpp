// SPDX-License-Identifier: MIT
#include "server/ingest/segment_model.h"

#include <algorithm>
#include <utility>

#include "server/segment/segment_parts.h"
#include "server/segment/triangle_labels.h"

namespace selvage {
namespace {

std::map<std::string, std::vector<RegionId>> name_regions(const Parts& parts,
                                                          const std::vector<std::uint32_t>& part_of_region) {
  std::map<std::uint32_t, std::vector<RegionId>> regions_of_part;
  for (RegionId region = 1; region < part_of_region.size(); ++region)
    regions_of_part[part_of_region[region]].push_back(region);
  std::map<std::string, std::vector<RegionId>> regions_of_name;
  for (const auto& [name, named] : parts.parts_of_name) {
    std::vector<RegionId> regions;
    for (std::uint32_t part : named) {
      const auto& found = regions_of_part[part];
      regions.insert(regions.end(), found.begin(), found.end());
    }
    std::sort(regions.begin(), regions.end());
    if (!regions.empty()) regions_of_name.emplace(name, std::move(regions));
  }
  return regions_of_name;
}

}  // namespace

NamedSegmentation segment_model(const RepairedMesh& mesh, const Parts& parts, const SegmentOptions& options,
                                const ParallelFor& parallel) {
  if (parts.empty()) return {segment(mesh.table, mesh.positions, options, parallel), {}};

  const std::vector<std::uint32_t> part_of_vertex = parts_of_vertices(mesh, parts);
  NamedSegmentation result;
  result.regions = segment_parts(mesh.table, mesh.positions, part_of_vertex,
                                 {.max_region_vertices = options.max_region_vertices});
  result.regions_of_name = name_regions(parts, parts_of_regions(result.regions, part_of_vertex));
  return result;
}

std::vector<RegionId> regions_of_source_triangles(const RepairedMesh& mesh, const Segmentation& segmentation,
                                                  std::size_t count) {
  const std::vector<RegionId> regions = regions_of_triangles(mesh.table, segmentation);
  std::vector<RegionId> of_source(count, kLooseRegion);
  for (TriangleId t = 0; t < regions.size(); ++t) of_source[mesh.source_of_triangle[t]] = regions[t];
  RegionId last = kLooseRegion;
  for (RegionId& region : of_source) last = region = region == kLooseRegion ? last : region;
  const auto first =
      std::find_if(of_source.begin(), of_source.end(), [](RegionId r) { return r != kLooseRegion; });
  if (first != of_source.end()) std::fill(of_source.begin(), first, *first);
  return of_source;
}

}  // namespace selvage
