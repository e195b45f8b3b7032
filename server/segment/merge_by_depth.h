// SPDX-License-Identifier: MIT
//
// Region merging by watershed depth [Mangan and Whitaker 1999], the method that the dissertation compares its
// own merging with in Fig. 4.16: the shallowest region flows over its lowest border.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/corner_table.h"
#include "server/segment/minima.h"

namespace selvage {

/// Merges until `target_count` labels are left, or none has a neighbour. The depth of a region is its lowest
/// pass minus its lowest vertex; a pass is the lowest edge to one neighbour, an edge being as high as its
/// higher end. Of equally shallow regions the lower label goes first, and to the lower label across equally
/// low passes. Each merge looks at all borders of the merged region again, as the original must.
void merge_by_depth(const CornerTable& mesh, std::span<const double> height_of_vertex, Minima& labels,
                    std::uint32_t target_count);

}  // namespace selvage
