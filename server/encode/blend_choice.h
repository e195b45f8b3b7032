// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/codec/region_format.h"

namespace selvage {

/// The blends that make this region's residuals smallest: sum of their logarithms over at most about a
/// thousand of its vertices, one blend after the other. Meshes differ most in this: corrections that help on
/// a simplified mesh hurt on a regular grid.
Blends choose_blends(const FanTable& table, std::span<const GridPoint> positions, const GridBox& box,
                     const CodecTables& tables);

}  // namespace selvage
