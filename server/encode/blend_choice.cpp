// SPDX-License-Identifier: MIT
#include "server/encode/blend_choice.h"

#include <cstdlib>
#include <limits>

namespace selvage {
namespace {

struct Sample {
  Surroundings around;
  IntLanes position;
};

std::int64_t cost_of(std::int32_t residual) {
  return log_size(2 * static_cast<std::uint64_t>(std::abs(std::int64_t{residual})));
}

std::int64_t cost_of(const std::vector<Sample>& samples, const Predictor& predictor) {
  std::int64_t cost = 0;
  for (const Sample& sample : samples) {
    const CodedResidual residual = residual_of(predictor, sample.around, sample.position);
    cost += cost_of(residual.u) + cost_of(residual.w) + cost_of(residual.last);
  }
  return cost;
}

/// Every nth vertex that a parallelogram predicts. Surroundings do not depend on blends.
std::vector<Sample> take_samples(const FanTable& table, std::span<const GridPoint> positions,
                                 const GridBox& box) {
  constexpr std::size_t kMost = 1024;
  const std::size_t every = positions.size() / kMost + 1;
  std::vector<Sample> samples;
  GeometryWalk::Memory memory;
  GeometryWalk walk(table, table.vertex_count(), box.extent(), memory);
  for (Surroundings around{}; walk.next_vertex(around);) {
    const GridPoint& position = positions[walk.old_number()];
    if (!around.has_neighbours) {
      walk.place_first(position);
      continue;
    }
    const IntLanes lanes{position.x, position.y, position.z, 0};
    if (walk.count() % every == 0 && around.parallelograms > 0) samples.push_back({around, lanes});
    walk.place(around, lanes, 0, 0);
  }
  return samples;
}

}  // namespace

Blends choose_blends(const FanTable& table, std::span<const GridPoint> positions, const GridBox& box,
                     const CodecTables& tables) {
  const std::vector<Sample> samples = take_samples(table, positions, box);
  Blends best;
  if (samples.size() < 16) return best;
  const auto improve = [&](unsigned Blends::*blend, unsigned most) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    Blends tried = best;
    for (unsigned value = 0; value <= most; ++value) {
      tried.*blend = value;
      const std::int64_t cost = cost_of(samples, Predictor(tables, tried));
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
