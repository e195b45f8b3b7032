// SPDX-License-Identifier: MIT
#include "server/encode/blend_choice.h"

#include <cstdlib>
#include <limits>

namespace selvage {
namespace {

struct Sample {
  Surroundings around;
  GridPoint position;
};

std::int64_t cost_of(std::int32_t residual) {
  return log_size(2 * static_cast<std::uint64_t>(std::abs(std::int64_t{residual})));
}

std::int64_t cost_of(const std::vector<Sample>& samples, const GeometryWalk& walk) {
  std::int64_t cost = 0;
  for (const Sample& sample : samples) {
    const GridPoint residual = sample.position - walk.predict(sample.around);
    const unsigned d = sample.around.normal_axis;
    const auto u = residual[static_cast<int>((d + 1) % 3)], w = residual[static_cast<int>((d + 2) % 3)];
    const std::int32_t last = residual[static_cast<int>(d)] - walk.tangent_residual(sample.around, u, w);
    cost += cost_of(u) + cost_of(w) + cost_of(last);
  }
  return cost;
}

/// Every nth vertex that a parallelogram predicts. Surroundings do not depend on blends.
std::vector<Sample> take_samples(const CornerTable& table, std::span<const GridPoint> positions,
                                 const GridBox& box, const CodecTables& tables) {
  constexpr std::size_t kMost = 1024;
  const std::size_t every = positions.size() / kMost + 1;
  std::vector<Sample> samples;
  GeometryWalk walk(table, tables, {}, box.extent());
  for (Surroundings around; walk.next_vertex(around);) {
    const GridPoint& position = positions[walk.old_number()];
    if (walk.count() % every == 0 && around.parallelograms > 0) samples.push_back({around, position});
    walk.place(around, position, 0, 0);
  }
  return samples;
}

}  // namespace

Blends choose_blends(const CornerTable& table, std::span<const GridPoint> positions, const GridBox& box,
                     const CodecTables& tables) {
  const std::vector<Sample> samples = take_samples(table, positions, box, tables);
  Blends best;
  if (samples.size() < 16) return best;
  const auto improve = [&](unsigned Blends::*blend, unsigned most) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    Blends tried = best;
    for (unsigned value = 0; value <= most; ++value) {
      tried.*blend = value;
      const std::int64_t cost = cost_of(samples, GeometryWalk(CornerTable{}, tables, tried, 0));
      if (cost < least) least = cost, best = tried;
    }
  };
  improve(&Blends::trend, Blends::kMax);
  improve(&Blends::shape, Blends::kMax);
  improve(&Blends::trend, Blends::kMax);
  improve(&Blends::tangent, Blends::kMaxTangent);
  return best;
}

}  // namespace selvage
