// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/codec/exact.h"
#include "common/coding/entropy_decoder.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// The mirror of server/encode/exact_encoder.h. Gives no NaN and no infinity.
Result<std::vector<ExactPosition>> decode_exact(std::span<const GridPoint> positions, const Grid& grid,
                                                EntropyDecoder& in);

}  // namespace selvage
