// SPDX-License-Identifier: MIT
//
// What joins are measured against: the dissertation's raw vertex sequences, and welding by position.
#pragma once

#include "bench/support/corpus.h"
#include "common/mesh/grid.h"

namespace selvage::bench {

/// Bytes of the boundary triangles as Table 5.4 stores them: generalised strips, a count of vertices and one
/// of triangles each, every vertex a region number and a boundary index of as many bits as the largest takes.
std::size_t raw_strip_bytes(const CornerTable& table, const Partition& partition,
                            std::uint32_t largest_loop_sum);

/// What a client would do without joins: every region carries its boundary triangles and their vertices
/// again, and vertices at equal grid points are taken for one.
struct Welding {
  std::uint32_t repeated_vertices = 0;  ///< copies that regions would carry besides their own
  std::uint32_t wrong_welds = 0;        ///< different vertices of the model that welding makes one
  double seconds = 0;                   ///< to find equal positions among boundary vertices, thread CPU time
};
Welding weld_by_position(const RepairedMesh& mesh, const Partition& partition, const Grid& grid);

double thread_seconds();

}  // namespace selvage::bench
