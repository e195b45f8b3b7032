// SPDX-License-Identifier: MIT
//
// What a second core brings to a client that decodes and stitches a pack of regions.
#pragma once

#include "bench/support/corpus.h"
#include "common/mesh/grid.h"

namespace selvage::bench {

/// Seconds from the first part's bytes to the last one's place in the stitcher; medians.
struct DecodingTimes {
  double one_core = 0, two_cores = 0;                ///< of CPU time, along the critical path
  double one_thread_wall = 0, two_threads_wall = 0;  ///< the least that a clock saw, on whatever is free
};
/// Regions of the given partition, coded with the shipped tables, through PartCollector as every tool decodes
/// them.
DecodingTimes decode_on_two_cores(const RepairedMesh& mesh, const Partition& partition, const Grid& grid,
                                  int repeats);

}  // namespace selvage::bench
