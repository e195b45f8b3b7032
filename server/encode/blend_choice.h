// SPDX-License-Identifier: MIT
#pragma once

#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"

namespace selvage {

/// The blends that make this region's residuals smallest: sum of their logarithms over at most about a
/// thousand of its vertices, one blend after the other. Meshes differ most in this: corrections that help on
/// a simplified mesh hurt on a regular grid.
Blends choose_blends(const RegionMesh& mesh, const GridBox& box, const CodecTables& tables);

}  // namespace selvage
