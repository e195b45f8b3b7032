// SPDX-License-Identifier: MIT
//
// Makes codec tables from meshes: weights by least squares, start models from counted symbols.
#pragma once

#include <string>
#include <vector>

#include "bench/support/corpus.h"
#include "common/codec/codec_tables.h"

namespace selvage::bench {

/// Tables that own what they are made of.
struct TrainedTables {
  std::vector<PackedModel> packed_region, packed_bundle;
  std::vector<bool> region_is_seen, bundle_is_seen;  ///< models that training never met stay fresh
  std::vector<StartModel> region, bundle;
  std::array<ShapeWeights, kShapeClasses> shape;
  std::array<std::array<SizeWeights, 3>, kSizeClasses> size;

  CodecTables view() const { return {region, bundle, shape, size}; }
};

/// Deterministic: a function of the models and their order.
TrainedTables train(const std::vector<const Model*>& models);

/// The text of common/codec/trained_tables.inc.
std::string to_source(const TrainedTables& tables);

}  // namespace selvage::bench
