// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "bench/simplify/layered/layered_levels.h"

namespace selvage::bench {

/// All parts of a region's layers, and the symbols that they were coded from if asked for. Checks on the way
/// that every level comes out as it was simplified. Finest layer first; empty where nothing is to be said.
std::vector<Bytes> encode_layers(const LayeredRegion& region, const RefinementTables& tables,
                                 const LayerWatch* watch = nullptr,
                                 std::vector<EntropyEncoder>* symbols = nullptr);

/// Deterministic.
RefinementTables train_refinement(std::span<const LayeredModel* const> models);

}  // namespace selvage::bench
