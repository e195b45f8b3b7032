// SPDX-License-Identifier: MIT
//
// Where a vertex may go, by what it is part of. A region triangle has three equal labels, any other is a
// boundary triangle; a loop vertex is one that a boundary triangle touches. Classes are found once: no legal
// collapse changes that of a vertex that stays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/corner_table.h"
#include "server/simplify/star.h"

namespace selvage {

enum class VertexClass : std::uint8_t {
  Interior,  ///< goes to any neighbour
  Border,    ///< on the mesh's border, region triangles only: goes along the border
  Chain,     ///< loop vertex facing one other region, off the border: goes along the loop, see is_allowed
  Pinned,  ///< every other loop vertex (junctions, loose vertices, loop ends at the border), copies of welds
};

/// `region_of_vertex` is empty or has a label a vertex. `pinned` vertices never move.
std::vector<VertexClass> classify_vertices(const CornerTable& mesh,
                                           std::span<const RegionId> region_of_vertex,
                                           std::span<const VertexId> pinned);

/// Whether the class lets the star's centre go to the ring vertex at `place`. A chain vertex goes only where
/// the edge has a region triangle on one side and, on the other, a boundary triangle whose third vertex is
/// the neighbour's: along its own loop, towards the same neighbour region.
bool is_allowed(VertexClass vertex_class, std::span<const RegionId> region_of_vertex, const Star& star,
                std::uint32_t place);

/// For a chain vertex and an allowed place: whether the region triangle at their edge, which will go, leaves
/// its piece of the region another one. All other collapses do.
bool keeps_region(const CornerTable& mesh, std::span<const RegionId> region_of_vertex, const Star& star,
                  std::uint32_t place);

}  // namespace selvage
