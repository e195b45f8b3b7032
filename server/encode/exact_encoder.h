// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/codec/exact.h"
#include "common/coding/entropy_encoder.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// The floats behind grid points that the decoder already has, in the same order.
/// Mirror: client/decode/exact_decoder.h.
void encode_exact(std::span<const GridPoint> positions, std::span<const ExactPosition> exact,
                  const Grid& grid, EntropyEncoder& out);

}  // namespace selvage
