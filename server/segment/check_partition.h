// SPDX-License-Identifier: MIT
#pragma once

#include "common/base/result.h"
#include "common/mesh/corner_table.h"
#include "server/segment/partition.h"

namespace selvage {

/// Checks that a partition fits the mesh and keeps the guarantees G1 to G5 of regularise.h: every triangle
/// listed once, in its place; every vertex of a region with exactly one fan of interior triangles; loose
/// exactly those without; each region edge-connected, or made of whole components of the mesh. A BadStream
/// error names the first violation. Linear time; for tests and tools. Needs a mesh that passes
/// check_corner_table.
Result<void> check_partition(const CornerTable& mesh, const Partition& partition);

}  // namespace selvage
