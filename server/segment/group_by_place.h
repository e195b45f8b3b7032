// SPDX-License-Identifier: MIT
//
// Dust (bolts, hairs, scanner noise: hundreds of tiny components) shares regions, so that a region is worth
// a request; components that lie together are asked for together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/vec3.h"
#include "server/segment/components.h"

namespace selvage {

/// The group of each component with fewer than `min_vertices` vertices, kNone for the others. Such components
/// are put in the Morton order of their mean vertex; a group ends once it has `min_vertices` vertices.
/// Where `part_of_component` is stated, a group never spans parts, and components of part kNone are not dust.
std::vector<std::uint32_t> group_by_place(const Components& components, std::span<const Vec3> positions,
                                          std::uint32_t min_vertices,
                                          std::span<const std::uint32_t> part_of_component = {});

}  // namespace selvage
