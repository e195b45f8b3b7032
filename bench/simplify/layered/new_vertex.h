// SPDX-License-Identifier: MIT
//
// What the surroundings of a new vertex say about its place. All of its ring is known, and of most triangles
// beyond the ring the third vertex, so that the parallelograms of all its triangles predict it at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "bench/simplify/layered/refinement_tables.h"
#include "bench/simplify/layered/split_mesh.h"
#include "common/codec/geometry_walk.h"
#include "common/codec/prediction.h"

namespace selvage::bench {

inline float dot3(FloatLanes a, FloatLanes b) {
  const FloatLanes p = a * b;
  return p[0] + p[1] + p[2];
}

/// The ring of a new vertex, as seen from the vertex that is split: its other points in counter-clockwise
/// order, and for each edge with something beyond it the parallelogram's tip.
class NewRing {
 public:
  /// A new vertex on the border has an open ring, at one end of which is the split vertex.
  NewRing(IntLanes split, SplitKind kind) : split_(split), kind_(kind) {}

  void add_point(IntLanes point) {
    const FloatLanes at = to_float(point - split_);
    if (points_++ == 0) first_ = at;
    sum_ += at;
    reach_ += absolute(at);
    normal_ += cross(last_, at);
    last_ = at;
  }
  void add_tip(IntLanes tip) {
    const FloatLanes at = to_float(tip - split_);
    if (tips_++ > 0) apart_ += absolute(at - last_tip_);
    tip_sum_ += at;
    last_tip_ = at;
  }
  /// Further points say little, and sums stay within bounds.
  static constexpr std::uint32_t kMost = Fan::kMost - 8;

 private:
  friend class PlaceModel;
  IntLanes split_;
  SplitKind kind_;
  unsigned points_ = 0, tips_ = 0;
  FloatLanes first_{}, last_{}, sum_{}, reach_{}, normal_{}, tip_sum_{}, apart_{}, last_tip_{};
};

/// Fills in `around`, its `mean` with the place to expect.
class PlaceModel {
 public:
  explicit PlaceModel(const RefinementTables& tables) {
    for (unsigned c = 0; c < kPlaceClasses; ++c)
      for (unsigned i = 0; i < kPlaceFeatures; ++i)
        weights_[c][i] = static_cast<float>(tables.place[c][i]) * (1.0F / 1024);
  }

  struct Features {
    unsigned place_class;
    FloatLanes mean;
    std::array<FloatLanes, kPlaceFeatures> steps;
  };

  [[gnu::always_inline]] Features look(const NewRing& ring, Surroundings& around) const {
    Features features;
    const bool is_open = ring.kind_ != SplitKind::Inner;
    const unsigned n = ring.points_ + 1, tips = ring.tips_;
    const float per_point = kReciprocal[n], per_tip = tips > 0 ? kReciprocal[tips] : 0;
    const FloatLanes mean = ring.sum_ * per_point, split = -mean;
    FloatLanes normal = ring.normal_;
    normal[3] = 0;
    const float square = dot3(normal, normal);
    const FloatLanes unit = square > 0 ? normal * (1.0F / __builtin_sqrtf(square)) : FloatLanes{};
    const FloatLanes beyond = tips > 0 ? ring.tip_sum_ * per_tip - mean : FloatLanes{};
    const float rise = dot3(beyond, unit), split_rise = dot3(split, unit);
    const FloatLanes far_end = ring.kind_ == SplitKind::AtStart ? ring.first_ : ring.last_;
    const FloatLanes ends = is_open ? far_end * 0.5F + split : FloatLanes{};
    features.mean = to_float(ring.split_) + mean;
    features.steps = {unit * rise, beyond - unit * rise, unit * split_rise, split - unit * split_rise, ends};
    features.place_class = (is_open ? 8 : 0) + (tips + 1 >= n ? 4 : 0) + std::clamp(n, 3u, 6u) - 3;
    around.has_neighbours = true;
    around.parallelograms = is_open ? 1 : 2;
    around.size_class = is_open ? 0 : std::clamp(n, 3u, 5u) - 2;
    around.shape_class = 0;
    const FloatLanes sums = sums_of_three(ring.reach_, ring.apart_);
    const FloatLanes sizes{sums[0] * per_point, __builtin_fabsf(split_rise), sums[1] * per_tip,
                           __builtin_fabsf(rise)};
    around.logs = to_float(log_of_magnitudes(sizes));
    around.recent = to_float(recent_);
    around.beyond = around.ring = around.trend = FloatLanes{};
    set_tangent_plane(normal, around);
    const auto& w = weights_[features.place_class];
    FloatLanes expected = features.mean;
    for (unsigned i = 0; i < kPlaceFeatures; ++i) expected += features.steps[i] * w[i];
    around.mean = expected;
    return features;
  }

  void note(std::uint32_t tangential, std::uint32_t normal) {
    const IntLanes sizes{static_cast<std::int32_t>(std::min(tangential, kMostCoordinate)),
                         static_cast<std::int32_t>(std::min(normal, kMostCoordinate)), 0, 0};
    recent_ += (log_of_magnitudes(to_float(sizes)) - recent_) >> 4;
  }
  void start(int log_of_size) { recent_ = splat(log_of_size << 20); }

 private:
  std::array<std::array<float, kPlaceFeatures>, kPlaceClasses> weights_;
  IntLanes recent_{};
};

}  // namespace selvage::bench
