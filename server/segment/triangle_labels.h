// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/mesh/corner_table.h"
#include "server/segment/segmentation.h"

namespace selvage {

/// A region for every triangle, as files and benchmarks of segmentations state it: the one that two of its
/// corners share; of a triangle with three, the lowest real one. kLooseRegion only if all its corners are
/// loose.
std::vector<RegionId> regions_of_triangles(const CornerTable& mesh, const Segmentation& segmentation);

}  // namespace selvage
