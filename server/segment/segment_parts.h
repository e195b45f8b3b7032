// SPDX-License-Identifier: MIT
//
// Regions from parts that somebody else chose: names in a file, labels of a rig, components. A part is one
// region, or several where it is large or lies in several places.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/regularise.h"
#include "server/segment/segmentation.h"

namespace selvage {

struct PartSizes {
  std::uint32_t max_region_vertices = 0;       ///< larger parts are cut into several regions; 0: none
  std::uint32_t min_component_vertices = 256;  ///< smaller components of one part share regions
};

/// Codable regions of which each lies in one part, apart from crumbs (regularise.h) where vertices of several
/// parts are neighbours. Where they are not, because the mesh was cut between parts, every part keeps every
/// triangle: between regions of the same part, with a real region in each. Linear time.
Segmentation segment_parts(const CornerTable& mesh, std::span<const Vec3> positions,
                           std::span<const std::uint32_t> part_of_vertex, const PartSizes& sizes);

/// The part that most vertices of each region have, by RegionId; kNone for the loose region. Ties go to the
/// lower part.
std::vector<std::uint32_t> parts_of_regions(const Segmentation& segmentation,
                                            std::span<const std::uint32_t> part_of_vertex);

}  // namespace selvage
