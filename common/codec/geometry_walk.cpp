// SPDX-License-Identifier: MIT
#include "common/codec/geometry_walk.h"

#include <bit>

namespace selvage {
GeometryWalk::GeometryWalk(const FanTable& table, std::uint32_t most_vertices, std::int32_t extent,
                           Memory& memory)
    : order_(table, most_vertices, memory.order), known_(memory.known.make(most_vertices)) {
  // Until residuals are known: about an edge's length, taking the region for a square.
  const int half_octaves = std::bit_width(table.triangle_count());
  recent_ = splat(log_size(static_cast<std::uint64_t>(extent) * 4 >> half_octaves / 2) << 20);
}

void GeometryWalk::place_first(const GridPoint& position) {
  known_[count_++] = {IntLanes{position.x, position.y, position.z, 0}, FloatLanes{}};
}

std::vector<GridPoint> GeometryWalk::positions() const {
  std::vector<GridPoint> positions(count_);
  for (VertexId v = 0; v < count_; ++v) {
    const IntLanes p = known_[v].position;
    positions[v] = {p[0], p[1], p[2]};
  }
  return positions;
}

}  // namespace selvage
