// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "common/pack/directory.h"

namespace selvage {

/// A part, or what is missing of it, by its place in the pack file.
struct WantedPiece {
  PartId id;
  std::uint64_t begin = 0, end = 0;
};

/// One request to a web server: the bytes [begin, end), and the pieces in them, ascending and apart.
struct PlannedRange {
  std::uint64_t begin = 0, end = 0;
  std::vector<WantedPiece> pieces;
};

struct RangePlanOptions {
  /// Pieces closer than this go in one request: so many bytes cost less than another request.
  std::uint64_t max_gap = 8u << 10;
  /// A request takes no further piece beyond this, so that several can run side by side, and a connection
  /// that breaks loses little. A larger piece has a request of its own.
  std::uint64_t max_bytes = 1u << 20;
};

/// The fewest requests that these options allow. `pieces` in any order, not overlapping, not empty.
std::vector<PlannedRange> plan_ranges(std::vector<WantedPiece> pieces, const RangePlanOptions& options = {});

}  // namespace selvage
