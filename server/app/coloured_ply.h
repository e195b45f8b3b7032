// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"
#include "common/render/image.h"

namespace selvage {

/// The soup as binary PLY whose faces carry `red green blue` and `region`, which mesh viewers show and read.
/// One region a triangle; one colour a region.
std::string coloured_ply(const TriangleSoup& soup, std::span<const RegionId> region_of_triangle,
                         std::span<const Rgb> colour_of_region);

}  // namespace selvage
