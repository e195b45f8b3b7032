// SPDX-License-Identifier: MIT
//
// First half of regularisation: rounds that give the crumbs of a labelling to their neighbours. They keep the
// number of loose vertices low; they guarantee nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/corner_table.h"
#include "server/segment/pieces.h"

namespace selvage {

/// One round; `pieces` are those of the labels. Of each label the largest edge-connected set of interior
/// triangles (the first of equal ones) keeps the label; other sets of at least `min_piece_triangles` get a
/// new label; the rest dissolves: a vertex whose kept triangles do not form exactly one fan takes the other
/// label that owns most complete edges of its link (both ends), if there is one, the lower if equal. Labels
/// are 0..label_count-1; new ones are added. Returns whether any label changed. Linear time.
bool dissolve_crumbs(const CornerTable& mesh, const Pieces& pieces, std::uint32_t min_piece_triangles,
                     std::vector<std::uint32_t>& label_of_vertex, std::uint32_t& label_count);

}  // namespace selvage
