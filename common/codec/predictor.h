// SPDX-License-Identifier: MIT
//
// Predicts a vertex from the vertices coded before it, in integers, the same on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// Half-octaves of the residual that is to be expected, plus the number of parallelograms (none, one, more).
struct ResidualContext {
  static constexpr unsigned kMagnitudes = 48;
  static constexpr unsigned kCount = kMagnitudes * 3;
  unsigned index = 0;    ///< < kCount
  int raw_low_bits = 0;  ///< bits of a residual's magnitude that are noise at this size and go uncoded
};

struct Prediction {
  GridPoint position;
  ResidualContext context;
};

/// Vertices must be numbered in coding order: only lower-numbered ones are known.
class Predictor {
 public:
  /// Coordinates are below 2^bits. `table` is kept by reference.
  Predictor(const CornerTable& table, int bits);

  /// For vertex number positions().size(): the mean of all parallelograms [Touma and Gotsman 1998] that known
  /// triangles span, else the mean of known neighbours, else the vertex before, else the middle of the grid.
  Prediction predict() const;

  /// What it turned out to be.
  void append(const GridPoint& position, const GridPoint& residual);

  const std::vector<GridPoint>& positions() const { return positions_; }
  std::vector<GridPoint> take() && { return std::move(positions_); }

 private:
  const CornerTable& table_;
  int bits_;
  std::vector<GridPoint> positions_;
  std::vector<std::uint32_t> residual_size_;  ///< by vertex: sum of the residual's magnitudes
};

}  // namespace selvage
