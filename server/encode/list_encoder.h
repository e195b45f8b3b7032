// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/codec/exact.h"
#include "common/codec/fan_table.h"
#include "common/coding/entropy_encoder.h"
#include "common/mesh/triangle_soup.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// Codes positions as places in lists of values (common/codec/value_lists.h). They come in the order that
/// encode_positions gives. Mirror: client/decode/list_decoder.h.
void encode_listed_positions(const FanTable& table, std::span<const GridPoint> positions,
                             EntropyEncoder& out);
/// The same for floats, of which each must be finite; the decoder finds their grid points.
void encode_listed_floats(const FanTable& table, std::span<const ExactPosition> exact, EntropyEncoder& out);

/// False where so few coordinates repeat along edges that lists can hardly be shorter: most scans.
bool may_be_listed(std::span<const Triangle> triangles, std::span<const GridPoint> positions);

}  // namespace selvage
