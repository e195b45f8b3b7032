// SPDX-License-Identifier: MIT
//
// Index spaces. All are 32-bit; a name says which space it counts in (`vertex_of_corner`).
#pragma once

#include <cstdint>

namespace selvage {

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;
using CornerId = std::uint32_t;  ///< 3 * triangle + place in the triangle
using RegionId = std::uint32_t;  ///< 0 is the loose pseudo-region, real regions start at 1

/// "No such element", in every index space.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// The pseudo-region of the vertices that fit in no region. It always exists, most often empty.
inline constexpr RegionId kLooseRegion = 0;

}  // namespace selvage
