// SPDX-License-Identifier: MIT
//
// Minima detection, dissertation section 4.2.2: the connected sets of non-plateau vertices are the catchment
// basins' cores, each with a label of its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/segment/neighbours.h"

namespace selvage {

struct Minima {
  std::vector<std::uint32_t> label_of_vertex;  ///< kNone on the plateau
  std::uint32_t count = 0;                     ///< labels are 0..count-1, numbered by first vertex
};

/// Linear time. `is_plateau` has a flag a vertex.
Minima label_minima(const Neighbours& neighbours, std::span<const std::uint8_t> is_plateau);

}  // namespace selvage
