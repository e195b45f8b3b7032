// SPDX-License-Identifier: MIT
//
// Second half of regularisation: takes the label from every vertex that keeps its region from being a
// manifold.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"

namespace selvage {

/// Sets vertices to kNone, and returns how many, until every other vertex has exactly one fan of interior
/// triangles. Labels only ever vanish, so it ends; each triangle stops being interior at most once and is
/// accounted for then, so time is linear even around vertices of enormous valence.
std::uint32_t loosen_misfits(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex);

}  // namespace selvage
