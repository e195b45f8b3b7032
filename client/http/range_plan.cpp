// SPDX-License-Identifier: MIT
#include "client/http/range_plan.h"

#include <algorithm>

namespace selvage {

std::vector<PlannedRange> plan_ranges(std::vector<WantedPiece> pieces, const RangePlanOptions& options) {
  std::ranges::sort(pieces, {}, &WantedPiece::begin);
  std::vector<PlannedRange> ranges;
  for (const WantedPiece& piece : pieces) {
    const bool joins = !ranges.empty() && piece.begin - ranges.back().end <= options.max_gap &&
                       piece.end - ranges.back().begin <= options.max_bytes;
    if (!joins) ranges.push_back({piece.begin, piece.begin, {}});
    ranges.back().end = piece.end;
    ranges.back().pieces.push_back(piece);
  }
  return ranges;
}

}  // namespace selvage
