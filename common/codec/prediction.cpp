// SPDX-License-Identifier: MIT
#include "common/codec/prediction.h"

namespace selvage {
namespace {

/// Stands for a feature that is always the same.
constexpr float kConstantFeature = 64;

/// Every product and sum is exact.
FloatLanes blended(std::int16_t weight, unsigned quarters) {
  return splat(static_cast<float>(weight * static_cast<int>(quarters)) * (1.0F / 4096));
}

}  // namespace

Predictor::Predictor(const CodecTables& tables, const Blends& blends)
    : tangent_blend_(static_cast<float>(blends.tangent) * 0.25F) {
  for (unsigned i = 0; i < kShapeClasses; ++i) {
    const ShapeWeights& weights = tables.shape[i];
    shape_[i] = {blended(weights.beyond, blends.shape), blended(weights.ring, blends.shape),
                 blended(weights.trend, blends.trend)};
  }
  for (unsigned c = 0; c < kSizeClasses; ++c) {
    const std::array<SizeWeights, 3>& axes = tables.size[c];
    for (unsigned i = 0; i < kCommonSizeFeatures; ++i) {
      size_[c][i] = FloatLanes{static_cast<float>(axes[0][i]), static_cast<float>(axes[1][i]),
                               static_cast<float>(axes[2][i]), 0};
    }
    // By logarithms as they come. Dividing by a power of two changes no bit of what a product gives.
    for (unsigned i = 0; i < 6; ++i) size_[c][i] *= 1 / kLogUnit;
    size_[c][6] *= kConstantFeature;
    known_[c] = {axes[1][7], {axes[2][7], axes[2][8]}};
  }
}

std::array<double, kSizeFeatures> Predictor::size_features(const Surroundings& around, std::int32_t log_u,
                                                           std::int32_t log_w) {
  const FloatLanes logs = around.logs * (1 / kLogUnit), recent = around.recent * (1 / kLogUnit);
  return {logs[0],
          logs[1],
          logs[2],
          logs[3],
          recent[0],
          recent[1],
          kConstantFeature,
          static_cast<double>(log_u),
          static_cast<double>(log_w)};
}

}  // namespace selvage
