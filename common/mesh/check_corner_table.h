// SPDX-License-Identifier: MIT
#pragma once

#include "common/base/result.h"
#include "common/mesh/corner_table.h"

namespace selvage {

/// Checks every invariant of a corner table: sizes, index ranges, no repeated vertex in a triangle, opposites
/// mutual with matching and oppositely directed edges, every vertex with exactly one fan, and
/// corner_of_vertex the most clockwise corner of an open fan. A BadStream error names the first violation.
/// Linear time; for tests and for `verify`, not for hot paths.
Result<void> check_corner_table(const CornerTable& table);

}  // namespace selvage
