// SPDX-License-Identifier: MIT
//
// Predicts a vertex, and how far off the prediction will be, from the vertices coded before it. Integers and
// single IEEE operations in a fixed order, the same on both sides and on every machine.
//
//        o            Every known triangle (a, o, b) across from the new vertex v spans a parallelogram,
//       / \           a + b - o [Touma and Gotsman 1998]. P is the mean of all of them, E the mean of the
//      a---b          middles of their edges ab, N the mean of all known neighbours of v, T the mean of the
//       \ /           neighbours' own errors against their P. The prediction is
//        v
//                     P + beyond * (P - E) + ring * (N - E) + trend * T
//
// with weights from training, by number of parallelograms, valence, and whether v lies on the border: (P - E)
// says how far parallelograms overshoot, (N - E) pulls towards the ring, T continues curvature.
//
// The axis that the surface's normal is closest to is coded last, when the other two residuals and the
// tangent plane already tell most of it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "common/codec/codec_tables.h"
#include "common/codec/lanes.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// How much of each correction a region takes: the encoder's choice, in quarters of the trained weight.
struct Blends {
  unsigned shape = 4;    ///< of beyond and ring, 0..kMaxBlend
  unsigned trend = 4;    ///< 0..kMaxBlend
  unsigned tangent = 4;  ///< of what the tangent plane says, 0..4
  static constexpr unsigned kMax = 7;
  static constexpr unsigned kMaxTangent = 4;
};

/// What the known surroundings of a vertex say about it, x, y, z in lanes 0 to 2. The last lanes mean
/// nothing. Without known neighbours nothing else is set.
struct Surroundings {
  bool has_neighbours;
  unsigned parallelograms;
  unsigned shape_class, size_class;
  unsigned normal_axis;
  FloatLanes mean, beyond, ring, trend;  ///< P, P - E, N - E, T; without parallelograms N, 0, 0, 0
  float slopes[2];                       ///< rise along the normal axis for a step along axis + 1, axis + 2
  FloatLanes logs;    ///< log_of_magnitudes: errors nearby, tangential and normal; spread; reach
  FloatLanes recent;  ///< running means of the same: tangential and normal residuals
};

/// How a residual of one axis is coded.
struct SizeClass {
  unsigned magnitude = 0;  ///< < region_model::kMagnitudes
  int raw_low_bits = 0;    ///< bits of the magnitude that are noise at this size and go uncoded
};

inline constexpr int kMostSize = 8 * 23 - 1;
/// By size: what lies below the highest four bits or so.
inline constexpr auto kRawLowBits = [] {
  std::array<std::uint8_t, kMostSize + 1> bits{};
  for (std::size_t size = 32; size < bits.size(); ++size)
    bits[size] = static_cast<std::uint8_t>(size / 8 - 4);
  return bits;
}();
/// What a residual takes at most besides its symbol: low bits and sign.
inline constexpr int kMostResidualBits = kMostSize / 8 - 4 + 1;

/// What of a magnitude goes through a model: the bits above raw_low_bits, or the escape.
inline constexpr std::uint32_t kMagnitudeEscape = 15;

/// 8 times the binary logarithm of x + 1, roughly: exact at powers of two, linear between.
constexpr std::int16_t log_size(std::uint64_t x) {
  ++x;
  const int octave = static_cast<int>(std::bit_width(x)) - 1;
  return static_cast<std::int16_t>(8 * octave + static_cast<int>((x << 3 >> octave) & 7));
}

/// log_size of four times a magnitude.
constexpr std::int16_t log_of_magnitude(std::uint32_t magnitude) {
  return log_size(4 * std::uint64_t{magnitude});
}

/// The logarithm of a residual by what its model said, so that the next axis need not wait for raw bits.
inline std::int32_t coarse_log(std::uint32_t symbol, const SizeClass& size) {
  static constexpr auto kLogs = [] {
    std::array<std::int16_t, kMagnitudeEscape + 1> logs{};
    for (unsigned m = 0; m < logs.size(); ++m) logs[m] = log_of_magnitude(m);
    return logs;
  }();
  return kLogs[symbol] + 8 * size.raw_low_bits;
}

/// Coordinates are below this; so sums over a fan stay within 32 bits.
inline constexpr std::uint32_t kMostCoordinate = 1u << 24;

inline std::uint32_t magnitude_of(std::int32_t residual) {
  return static_cast<std::uint32_t>(residual < 0 ? -residual : residual);
}

class Predictor {
 public:
  Predictor(const CodecTables& tables, const Blends& blends);

  /// The position to expect.
  IntLanes predict(const Surroundings& around) const {
    const Shape& weights = shape_[around.shape_class];
    const FloatLanes corrected = around.mean + weights.beyond * around.beyond + weights.ring * around.ring +
                                 weights.trend * around.trend;
    return rounded(corrected);
  }

  /// What the tangent plane says about the residual along around.normal_axis, given the other two.
  std::int32_t tangent_residual(const Surroundings& around, std::int32_t u, std::int32_t w) const {
    const float rise = around.slopes[0] * static_cast<float>(u) + around.slopes[1] * static_cast<float>(w);
    return static_cast<std::int32_t>(rise * tangent_blend_);
  }

  /// How big residuals are to be expected, by axis as coded: two tangential ones, then the normal one. In
  /// 256ths of log_size.
  IntLanes expected_sizes(const Surroundings& around) const;
  /// The class of one axis, given what coarse_log makes of the axes before it.
  SizeClass size_class(const Surroundings& around, IntLanes expected, unsigned axis, std::int32_t log_u,
                       std::int32_t log_w) const {
    const KnownResiduals& weights = known_[around.size_class];
    std::int32_t sum = expected[axis];
    if (axis == 1) sum += weights.second * log_u;
    if (axis == 2) sum += weights.third[0] * log_u + weights.third[1] * log_w;
    // Compares that become moves: jumps would be mispredicted.
    int clamped = sum >> 8;
    clamped = clamped < 0 ? 0 : clamped;
    const auto size = static_cast<unsigned>(clamped > kMostSize ? kMostSize : clamped);
    return {size / 4, kRawLowBits[size]};
  }
  /// What size classes weigh, for training.
  static std::array<double, kSizeFeatures> size_features(const Surroundings& around, std::int32_t log_u,
                                                         std::int32_t log_w);

 private:
  struct Shape {
    FloatLanes beyond, ring, trend;  ///< the same in all lanes
  };
  struct KnownResiduals {
    std::int32_t second, third[2];
  };

  std::array<Shape, kShapeClasses> shape_;  ///< blended
  /// By size class and feature, a lane an axis.
  std::array<std::array<FloatLanes, kCommonSizeFeatures>, kSizeClasses> size_;
  std::array<KnownResiduals, kSizeClasses> known_;
  float tangent_blend_;
};

inline IntLanes Predictor::expected_sizes(const Surroundings& around) const {
  const auto& weights = size_[around.size_class];
  // Those last that the last vertex's position decides: everything waits for them.
  const FloatLanes& logs = around.logs;
  const FloatLanes known_first = weights[6] + weights[4] * around.recent[0] + weights[5] * around.recent[1];
  const FloatLanes sum = known_first + (weights[0] * logs[0] + weights[1] * logs[1]) +
                         (weights[2] * logs[2] + weights[3] * logs[3]);
  return __builtin_convertvector(sum, IntLanes);
}

}  // namespace selvage
