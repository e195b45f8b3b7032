// SPDX-License-Identifier: MIT
//
// Branch pruning, dissertation section 4.2.5, Fig. 4.10 and Table 4.4: a vertex that only boundary triangles
// touch sticks out of its region and is given to a neighbour region.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"

namespace selvage {

/// One pass in vertex order, as in the table. "Its neighbour region number" is not defined there; here it is
/// the label of most neighbours among those that differ from the vertex's own, the lower one if equal. One
/// pass can leave and make new branches: codability is the work of regularise(), this is only the text's own
/// step. Returns the number of vertices changed. Linear time.
std::uint32_t prune_branches(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex);

}  // namespace selvage
