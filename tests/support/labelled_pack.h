// SPDX-License-Identifier: MIT
//
// A pack with regions chosen by the test instead of by the segmentation, whose floating point may move a few
// labels between compilers.
#pragma once

#include <span>

#include "common/coding/byte_io.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// Any label a vertex of the soup; regularisation makes them codable.
Bytes labelled_pack(const TriangleSoup& soup, std::span<const std::uint32_t> label_of_vertex, int bits,
                    bool is_exact = false, std::span<const double> level_ratios = {});

/// Labels that form patches: vertices in cubes of side `cell` share one.
std::vector<std::uint32_t> cube_labels(const TriangleSoup& soup, double cell);

}  // namespace selvage
