// SPDX-License-Identifier: MIT
//
// Predicts a vertex, and how far off the prediction will be, from the vertices coded before it. Integers
// only, the same on both sides.
//
//        o            Every known triangle (a, o, b) across from the new vertex v spans a parallelogram,
//       / \           a + b - o [Touma and Gotsman 1998]. P is the mean of all of them, E the mean of the
//       middles
//      a---b          of their edges ab, N the mean of all known neighbours of v, T the mean of the
//      neighbours'
//       \ /           own errors against their P. The prediction is
//        v
//                     P + beyond * (P - E) + ring * (N - E) + trend * T
//
// with weights from training, by number of parallelograms, valence, and whether v lies on the border: (P - E)
// says how far parallelograms overshoot, (N - E) pulls towards the ring, T continues curvature.
//
// The axis that the surface's normal is closest to is coded last, when the other two residuals and the
// tangent plane already tell most of it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "common/codec/codec_tables.h"
#include "common/mesh/corner_table.h"
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

/// What the known surroundings of a vertex say about it. Means are relative to `base`, in 16ths of a grid
/// step.
struct Surroundings {
  unsigned parallelograms = 0, neighbours = 0;
  unsigned shape_class = 0, size_class = 0;
  GridPoint base;
  std::array<std::int32_t, 3> edge{}, beyond{}, ring{}, trend{};
  unsigned normal_axis = 2;
  std::array<std::int32_t, 3> normal{};  ///< 15 bits and sign; zero if unknown
  std::array<std::int32_t, 4> sizes{};  ///< logarithms: tangential and normal residuals nearby, spread, reach
};

/// How a residual of one axis is coded.
struct SizeClass {
  unsigned magnitude = 0;  ///< < region_model::kMagnitudes
  int raw_low_bits = 0;    ///< bits of the magnitude that are noise at this size and go uncoded
};

/// 8 times the binary logarithm of x + 1, roughly: exact at powers of two, linear between.
inline std::int32_t log_size(std::uint64_t x) {
  ++x;
  const int octave = static_cast<int>(std::bit_width(x)) - 1;
  return 8 * octave + static_cast<std::int32_t>((x << 3 >> octave) & 7);
}

class Predictor {
 public:
  /// `table` and `tables` are kept by reference. Vertices must be numbered in coding order: only
  /// lower-numbered ones are known. `extent` is the longest side of the region's box, coordinates are below
  /// 2^24.
  Predictor(const CornerTable& table, const CodecTables& tables, const Blends& blends, std::int32_t extent);

  /// Of vertex number count().
  Surroundings look_around() const;
  /// The position to expect; the first vertex of a component has nothing but the vertex before.
  GridPoint predict(const Surroundings& around) const;
  /// What the tangent plane says about the residual along around.normal_axis, given the other two.
  std::int32_t tangent_residual(const Surroundings& around, std::int32_t u, std::int32_t w) const;

  /// The features of a residual's size: axis 0 and 1 are tangential, 2 the normal one. `u`, `w`: residuals of
  /// the axes before it, 0 if there are none yet; `tangent` for axis 2.
  std::array<std::int32_t, kSizeFeatures> size_features(const Surroundings& around, std::uint32_t u,
                                                        std::uint32_t w, std::uint32_t tangent) const;
  SizeClass size_class(const Surroundings& around, unsigned axis,
                       const std::array<std::int32_t, kSizeFeatures>& features) const;

  /// A vertex without neighbours, which nothing predicts.
  void append_first(const GridPoint& position) { known_.push_back({position, {}, 0, 0}); }
  /// What it turned out to be. `tangential` and `normal` are the magnitudes of the coded residuals.
  void append(const Surroundings& around, const GridPoint& position, std::uint32_t tangential,
              std::uint32_t normal);

  std::uint32_t count() const { return static_cast<std::uint32_t>(known_.size()); }
  std::vector<GridPoint> positions() const;

 private:
  struct Known {
    GridPoint position;
    GridPoint error;  ///< against the mean parallelogram
    std::uint32_t tangential = 0, normal = 0;
  };

  const CornerTable& table_;
  const CodecTables& tables_;
  unsigned tangent_blend_;
  std::array<ShapeWeights, kShapeClasses> shape_;  ///< blended
  std::vector<Known> known_;
  std::int32_t recent_tangential_, recent_normal_;  ///< running means of logarithms, in 32nds
};

}  // namespace selvage
