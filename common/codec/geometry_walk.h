// SPDX-License-Identifier: MIT
//
// Vertices one by one in the order of a FanWalk, each with what the positions of those before say about it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/codec/fan_walk.h"
#include "common/codec/prediction.h"
#include "common/codec/scratch.h"
#include "common/mesh/vec3.h"

namespace selvage {

class GeometryWalk {
  /// Sums over neighbours are sums of lanes.
  struct Known {
    IntLanes position;  ///< below kMostCoordinate, and the tangential residual
    FloatLanes error;   ///< against the mean parallelogram, and the normal residual
  };

 public:
  /// What a walk needs room for, kept between walks.
  struct Memory {
    FanWalk::Memory order;
    Scratch<Known> known;
  };

  /// Ends after `most_vertices` at the latest. `extent` is the longest side of the region's box; coordinates
  /// are below 2^24. Borrows `table` and `memory`.
  GeometryWalk(const FanTable& table, std::uint32_t most_vertices, std::int32_t extent, Memory& memory);

  /// Goes to the next vertex and looks around; false after the last. Every call must be followed by place()
  /// or place_first() before the next.
  bool next_vertex(Surroundings& around);
  /// The number that the current vertex had in the table.
  VertexId old_number() const { return fan_of(count_).old_number; }

  /// A third of the work for a vertex that comes later, which next_vertex() would do otherwise. A decoder
  /// does it between the symbols of a vertex, each of which must wait for the one before: 0, 1, 2, all or
  /// none.
  template <int kStep>
  void work_ahead();

  /// What the current vertex turned out to be. `tangential` and `normal` are the magnitudes of the coded
  /// residuals.
  /// Whatever a stream claims, what of a coordinate lies beyond 24 bits is ignored.
  void place(const Surroundings& around, IntLanes position, std::uint32_t tangential, std::uint32_t normal);
  /// A vertex without neighbours, which nothing predicts.
  void place_first(const GridPoint& position);

  /// Vertices placed so far.
  std::uint32_t count() const { return count_; }
  std::vector<GridPoint> positions() const;
  FanWalk& order() { return order_; }

 private:
  Fan& fan_of(VertexId v) { return fans_[v % kFans]; }
  const Fan& fan_of(VertexId v) const { return fans_[v % kFans]; }
  void look_around(const Fan& fan, Surroundings& around) const;

  FanWalk order_;
  static constexpr std::uint32_t kFans = 8;
  std::array<Fan, kFans> fans_;  ///< of the current vertex and those after it that were visited, by number
  bool is_ahead_ = false;
  Known* known_;  ///< by number
  VertexId count_ = 0;
  IntLanes recent_;  ///< running means of log_of_magnitudes of the residuals, tangential and normal
};

template <int kStep>
[[gnu::always_inline]] inline void GeometryWalk::work_ahead() {
  if (kStep == 0) is_ahead_ = order_.count() - count_ < kFans && order_.turn();
  if (!is_ahead_) return;
  if (kStep == 1) order_.offer();
  if (kStep == 2) order_.gather(fan_of(order_.count()));
}

inline constexpr std::array<float, Fan::kMost + 1> kReciprocal = [] {
  std::array<float, Fan::kMost + 1> reciprocal{};
  for (unsigned n = 1; n <= Fan::kMost; ++n) reciprocal[n] = 1.0F / static_cast<float>(n);
  return reciprocal;
}();

inline unsigned shape_class_of(unsigned parallelograms, unsigned valence, bool is_border) {
  const unsigned count = std::min(parallelograms, 4u) - 1;
  const unsigned ring = std::clamp(valence, 3u, 10u) - 3;
  return (count * 8 + ring) * 2 + is_border;
}

/// Finds the axis that a normal is closest to, and how the plane rises along it.
inline void set_tangent_plane(FloatLanes normal, Surroundings& around) {
  // Without jumps: which axis it is can't be guessed. By whether x >= y, y >= z and z >= x.
  static constexpr std::uint8_t kAxis[8] = {2, 0, 1, 0, 2, 2, 1, 1};
  const FloatLanes size = absolute(normal);
  const unsigned axis = kAxis[sign_bits(size >= __builtin_shufflevector(size, size, 1, 2, 0, 3)) & 7];
  const float twice[] = {normal[0], normal[1], normal[2], normal[0], normal[1]};
  const float along = twice[axis], scale = along == 0 ? 0 : -1.0F / along;
  around.normal_axis = axis;
  around.slopes[0] = twice[axis + 1] * scale;
  around.slopes[1] = twice[axis + 2] * scale;
}

[[gnu::always_inline]] inline void GeometryWalk::look_around(const Fan& fan, Surroundings& around) const {
  const Known* known = known_;
  const unsigned m = fan.neighbours, n = fan.parallelograms;
  IntLanes ring{};
  FloatLanes errors{};
  for (unsigned i = 0; i < m; ++i) {
    const Known& neighbour = known[fan.neighbour[i]];
    ring += neighbour.position;
    errors += neighbour.error;
  }
  const FloatLanes mean_ring = to_float(ring) * kReciprocal[m], mean_error = errors * kReciprocal[m];
  const FloatLanes sizes_nearby = __builtin_shufflevector(mean_ring, mean_error, 3, 7, 3, 7);

  around.parallelograms = n;
  around.size_class = std::min(n, 3u);
  around.recent = to_float(recent_);
  if (n == 0) {
    around.shape_class = 0;
    around.mean = mean_ring;
    around.beyond = around.ring = around.trend = FloatLanes{};
    around.normal_axis = 2;
    around.slopes[0] = around.slopes[1] = 0;
    around.logs =
        to_float(log_of_magnitudes(__builtin_shufflevector(sizes_nearby, FloatLanes{}, 0, 1, 4, 5)));
    return;
  }

  IntLanes tips{}, edges{}, tip;
  FloatLanes normal{};
  unsigned i = 0;
  do {
    const Fan::Parallelogram& at = fan.parallelogram[i];
    const IntLanes p = known[at.begin].position, q = known[at.end].position, r = known[at.across].position;
    const IntLanes edge = p + q;
    tip = edge - r;
    edges += edge;
    tips += tip;
    normal += cross(to_float(q - p), to_float(r - p));
  } while (++i < n);

  const FloatLanes mean = to_float(tips) * kReciprocal[n], edge = to_float(edges) * (0.5F * kReciprocal[n]);
  around.shape_class = shape_class_of(n, fan.triangles, fan.is_border);
  around.mean = mean;
  around.beyond = mean - edge;
  around.ring = mean_ring - edge;
  around.trend = mean_error;
  const FloatLanes sums = sums_of_three(absolute(to_float(tip) - mean), absolute(around.beyond));
  around.logs = to_float(log_of_magnitudes(__builtin_shufflevector(sizes_nearby, sums, 0, 1, 4, 5)));
  set_tangent_plane(normal, around);
}

[[gnu::always_inline]] inline bool GeometryWalk::next_vertex(Surroundings& around) {
  if (count_ == order_.count()) {
    work_ahead<0>();
    if (!is_ahead_) return false;
    work_ahead<1>();
    work_ahead<2>();
  }
  const Fan& fan = fan_of(count_);
  around.has_neighbours = fan.neighbours > 0;
  if (around.has_neighbours) look_around(fan, around);
  return true;
}

inline void GeometryWalk::place(const Surroundings& around, IntLanes position, std::uint32_t tangential,
                                std::uint32_t normal) {
  constexpr std::uint32_t kMost = kMostCoordinate;
  const IntLanes sizes{static_cast<std::int32_t>(std::min(tangential, kMost)),
                       static_cast<std::int32_t>(std::min(normal, kMost)), 0, 0};
  const FloatLanes float_sizes = to_float(sizes);
  position &= static_cast<std::int32_t>(kMost - 1);
  Known& known = known_[count_++];
  FloatLanes error{};
  if (around.parallelograms > 0) error = to_float(position) - around.mean;
  error[3] = float_sizes[1];
  position[3] = sizes[0];
  known.position = position;
  known.error = error;
  recent_ += (log_of_magnitudes(float_sizes) - recent_) >> 4;
}

}  // namespace selvage
