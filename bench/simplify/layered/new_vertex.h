// SPDX-License-Identifier: MIT
//
// What the surroundings of a new vertex say about its place. All of its ring is known, and of most triangles
// beyond the ring the third vertex, so that the parallelograms of all its triangles predict it at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "bench/simplify/layered/refinement_tables.h"
#include "common/codec/geometry_walk.h"
#include "common/codec/prediction.h"

namespace selvage::bench {

inline float dot3(FloatLanes a, FloatLanes b) {
  const FloatLanes p = a * b;
  return p[0] + p[1] + p[2];
}

/// The ring r[0..n) in order, closed or not, the split vertex among them, and the vertices beyond its edges.
struct NewRing {
  static constexpr unsigned kMost = 14;
  IntLanes point[kMost + 1];
  IntLanes tip[kMost + 1];  ///< r[i] + r[i + 1] - what lies beyond
  unsigned points = 0, tips = 0;
  IntLanes split;  ///< where the split vertex is
  bool is_open = false;
};

/// Fills in `around`, its `mean` with the place to expect.
class PlaceModel {
 public:
  explicit PlaceModel(const RefinementTables& tables) {
    for (unsigned c = 0; c < kPlaceClasses; ++c)
      for (unsigned i = 0; i < kPlaceFeatures; ++i)
        weights_[c][i] = static_cast<float>(tables.place[c][i]) * (1.0F / 1024);
  }

  static unsigned place_class(const NewRing& ring) {
    return (ring.is_open ? 8 : 0) + (ring.tips + 1 >= ring.points ? 4 : 0) +
           std::clamp(ring.points, 3u, 6u) - 3;
  }

  struct Features {
    FloatLanes mean;
    std::array<FloatLanes, kPlaceFeatures> steps;
  };

  [[gnu::always_inline]] Features look(const NewRing& ring, Surroundings& around) const {
    Features features;
    const unsigned n = ring.points, tips = ring.tips;
    // All in one turn, as seen from the split vertex.
    FloatLanes sum{}, normal{}, reach{}, before{};
    const FloatLanes begin = to_float(ring.point[0] - ring.split);
    for (unsigned i = 0; i < n; ++i) {
      const FloatLanes at = to_float(ring.point[i] - ring.split);
      sum += at;
      reach += absolute(at);
      normal += cross(before, at);
      before = at;
    }
    const float per_point = kReciprocal[n];
    const FloatLanes split = sum * -per_point, mean = to_float(ring.split) - split;
    normal[3] = 0;
    const float square = dot3(normal, normal);
    const FloatLanes unit = square > 0 ? normal * (1.0F / __builtin_sqrtf(square)) : FloatLanes{};
    const float height = 0;
    FloatLanes beyond{};
    float spread = 0;
    if (tips > 0) {
      IntLanes all{};
      FloatLanes apart{};
      for (unsigned i = 0; i < tips; ++i) {
        all += ring.tip[i];
        apart += absolute(to_float(ring.tip[i] - ring.tip[i + 1 < tips ? i + 1 : 0]));
      }
      beyond = to_float(all) * kReciprocal[tips] - mean;
      spread = (apart[0] + apart[1] + apart[2]) * kReciprocal[tips];
    }
    const FloatLanes ends = ring.is_open ? (begin + before) * 0.5F + split : FloatLanes{};
    const float rise = dot3(beyond, unit), split_rise = dot3(split, unit);
    features.mean = mean;
    features.steps = {unit * rise, beyond - unit * rise, unit * split_rise, split - unit * split_rise, ends};
    around.has_neighbours = true;
    around.parallelograms = ring.is_open ? 1 : 2;
    around.size_class = ring.is_open ? 0 : std::clamp(n, 3u, 5u) - 2;
    around.shape_class = 0;
    const FloatLanes sizes{(reach[0] + reach[1] + reach[2]) * per_point, height * per_point, spread,
                           __builtin_fabsf(rise)};
    around.logs = from_log(log_of_magnitudes(sizes));
    around.recent = from_log(recent_);
    around.beyond = around.ring = around.trend = FloatLanes{};
    set_tangent_plane(normal, around);
    const auto& w = weights_[place_class(ring)];
    FloatLanes expected = mean;
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
