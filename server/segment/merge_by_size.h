// SPDX-License-Identifier: MIT
//
// Region merging of the classic mode, dissertation section 4.2.4 and Table 4.3: a region with too few
// vertices joins the neighbour that it shares the longest boundary with.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"

namespace selvage {

/// Merges, in the order of labels and pass after pass, every region of fewer than `min_vertices` vertices;
/// labels are 0..region_count-1 before and 0..n-1 after, n being returned. The merged region goes by the
/// target's label. Length is the number of mesh edges between the two (the text says vertices); of equal ones
/// the lower label wins. A small region without neighbours stays, so it ends on every input (the table would
/// loop for ever): each pass at least halves the number of small regions that have neighbours. O(E log B) for
/// E borders of B regions.
std::uint32_t merge_by_size(const CornerTable& mesh, std::span<std::uint32_t> label_of_vertex,
                            std::uint32_t region_count, std::uint32_t min_vertices);

/// The usual `min_vertices`: 1 % of the mesh's vertices, at least 3.
std::uint32_t default_merge_threshold(std::uint32_t vertex_count);

}  // namespace selvage
