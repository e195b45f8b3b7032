// SPDX-License-Identifier: MIT
//
// What the layered coder knows before the first byte, as codec_tables.h for regions that stand alone.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/codec/codec_tables.h"

namespace selvage::bench {

namespace refinement_model {
inline constexpr unsigned kHistories = 4, kDegrees = 8;
inline constexpr unsigned kRuns = 3;  ///< boundary indices that a vertex stands for: 1, 2, more; or inside
enum Field : unsigned {
  kMagnitude = 0,  ///< as in a region part
  kExcess = 3 * 2 * region_model::kMagnitudes,
  kClosed,  ///< + is_finest, history, degree: triangles that go to a new vertex, 0 if none does
  kOpen = kClosed + 2 * kHistories * kDegrees,            ///< + is_finest, run, history, degree: SplitKind
  kOpenSpan = kOpen + 2 * kRuns * kHistories * kDegrees,  ///< + kind, degree
  kRank = kOpenSpan + 4 * kDegrees,  ///< + span, candidates: which of the places for such a run
  kBoundaryRun = kRank + 8 * 8,      ///< + run: boundary indices that the new vertex takes, less one
  kSpanExcess = kBoundaryRun + 8,    ///< bit lengths, as the next
  kRankExcess,
  kRunExcess,
  kCount
};
}  // namespace refinement_model

/// Weights of what surrounds a new vertex, in 1024ths; see new_vertex.h.
inline constexpr unsigned kPlaceFeatures = 5, kPlaceClasses = 16;
using PlaceWeights = std::array<std::int16_t, kPlaceFeatures>;

struct RefinementTables {
  std::vector<StartModel> models;
  std::array<PlaceWeights, kPlaceClasses> place{};
  std::array<std::array<SizeWeights, 3>, kSizeClasses> size{};
};

}  // namespace selvage::bench
