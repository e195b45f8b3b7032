// SPDX-License-Identifier: MIT
//
// The models of residual coding. One axis: magnitude m is split at the context's raw_low_bits k. m >> k is a
// symbol 0..14, or 15 and the excess as a number; then the low k bits; then, unless m is 0, the sign.
// Mirrors: server/encode/geometry_encoder.cpp, client/decode/geometry_decoder.cpp.
#pragma once

#include <vector>

#include "common/codec/predictor.h"
#include "common/coding/adaptive_model.h"

namespace selvage {

struct ResidualModels {
  static constexpr unsigned kEscape = 15;
  std::vector<AdaptiveModel<16>> magnitude = std::vector<AdaptiveModel<16>>(ResidualContext::kCount);
  AdaptiveModel<33> excess;
};

/// More than any valid residual can be: predictions lie within 3 * 2^24 of the grid.
inline constexpr std::uint32_t kMaxResidual = 1u << 27;

}  // namespace selvage
