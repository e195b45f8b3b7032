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
  /// Logarithms as codec_tables.h lists them; the last place is for the first axis.
  std::array<std::int16_t, kCommonSizeFeatures + 1> sizes{};
};

/// How a residual of one axis is coded.
struct SizeClass {
  unsigned magnitude = 0;  ///< < region_model::kMagnitudes
  int raw_low_bits = 0;    ///< bits of the magnitude that are noise at this size and go uncoded
};

/// 8 times the binary logarithm of x + 1, roughly: exact at powers of two, linear between.
inline std::int16_t log_size(std::uint64_t x) {
  ++x;
  const int octave = static_cast<int>(std::bit_width(x)) - 1;
  return static_cast<std::int16_t>(8 * octave + static_cast<int>((x << 3 >> octave) & 7));
}

class GeometryWalk {
 public:
  /// Vertices of `table` may have any numbers below 2^31, vertices without corner are passed over. `tables`
  /// is kept by reference. `extent` is the longest side of the region's box; coordinates are below 2^24.
  GeometryWalk(CornerTable table, const CodecTables& tables, const Blends& blends, std::int32_t extent);

  /// Goes to the next vertex and looks around; false after the last. Every call must be followed by place()
  /// or place_first() before the next.
  bool next_vertex(Surroundings& around);
  /// The number that the current vertex had in the table.
  VertexId old_number() const { return current_; }
  /// Vertices placed so far.
  std::uint32_t count() const { return count_; }

  /// The position to expect.
  GridPoint predict(const Surroundings& around) const;
  /// What the tangent plane says about the residual along around.normal_axis, given the other two.
  std::int32_t tangent_residual(const Surroundings& around, std::int32_t u, std::int32_t w) const;
  /// How big a residual is to be expected: axis 0 and 1 are tangential, 2 the normal one. `u`, `w`:
  /// magnitudes on the axes before it; `tangent`: of tangent_residual, for axis 2. 0 where not yet known.
  SizeClass size_class(const Surroundings& around, unsigned axis, std::uint32_t u, std::uint32_t w,
                       std::uint32_t tangent) const;
  /// What size_class weighs, for training.
  std::array<std::int16_t, kSizeFeatures> size_features(const Surroundings& around, std::uint32_t u,
                                                        std::uint32_t w, std::uint32_t tangent) const;

  /// What the current vertex turned out to be. `tangential` and `normal` are the magnitudes of the coded
  /// residuals.
  void place(const Surroundings& around, const GridPoint& position, std::uint32_t tangential,
             std::uint32_t normal);
  /// A vertex without neighbours, which nothing predicts.
  void place_first(const GridPoint& position);

  /// The table with vertices numbered by visit, and their positions. The walk is spent.
  CornerTable take_table();
  std::vector<GridPoint> positions() const;

 private:
  struct Known {
    GridPoint position;
    GridPoint error;  ///< against the mean parallelogram
    std::uint32_t tangential = 0, normal = 0;
  };
  /// How many triangles predict a vertex that is not yet known; two stands for more.
  enum State : std::uint8_t { kUnseen, kOnce, kWell, kVisited };

  bool find_next();
  void look_around(Surroundings& around);

  CornerTable table_;  ///< visited vertices already have their new numbers, the others kUnvisited added
  const CodecTables& tables_;
  unsigned tangent_blend_;
  std::array<ShapeWeights, kShapeClasses> shape_;  ///< blended
  std::vector<std::uint8_t> states_;               ///< by old number
  std::vector<VertexId> well_, once_;              ///< queues of old numbers
  std::size_t next_well_ = 0, well_end_ = 0, next_once_ = 0, once_end_ = 0;
  CornerId next_seed_ = 0;
  VertexId current_ = kNone;
  std::vector<CornerId> corner_of_visited_;
  std::vector<Known> known_;  ///< by new number; one of zeros behind the last stands for all unvisited
  VertexId count_ = 0;
  std::int32_t recent_tangential_, recent_normal_;  ///< running means of logarithms, in 32nds
};

}  // namespace selvage
