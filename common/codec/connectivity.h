// SPDX-License-Identifier: MIT
//
// From the grown triangles to a region's final connectivity: the steps between connectivity and geometry that
// encoder and decoder share.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/codec/fan_table.h"

namespace selvage {

/// A region's boundary loops other than its outer one are coded as if closed by a fan around a virtual
/// vertex. Takes those fans away again. Gives the numbers that triangles had, or an empty list if they stay
/// as they are; corners keep their place in their triangle. Nothing if the virtual vertices are not
/// ascending, out of range, or not inside the mesh: the stream is corrupt.
std::optional<std::vector<TriangleId>> drop_virtual_fans(FanTable& table,
                                                         std::span<const VertexId> virtual_vertices);

}  // namespace selvage
