// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

struct SplitTable {
  CornerTable table;                       ///< every vertex has exactly one fan
  std::vector<VertexId> source_of_vertex;  ///< by vertex of the table: the vertex it is, or is a copy of
};

/// Gives every fan of triangles around a vertex a vertex of its own, numbered by first use, so that bow-ties
/// and the ends of cuts come apart, and vertices without triangles disappear. Needs mutual, oppositely
/// directed opposites. Linear time.
SplitTable split_fans(std::vector<VertexId> source_of_corner, std::vector<CornerId> opposite);

}  // namespace selvage
