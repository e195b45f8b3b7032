// SPDX-License-Identifier: MIT
#include "common/codec/region_format.h"

#include <algorithm>
#include <bit>
#include <string>

namespace selvage {

void write_region_header(ByteWriter& out, const RegionPartHeader& header) {
  out.u8(static_cast<std::uint8_t>(kRegionPartVersion | header.has_turned << 4 | header.has_anchors << 5 |
                                   header.has_exact << 6 | header.is_coarse << 7));
}

Result<RegionPartHeader> read_region_header(ByteReader& in) {
  const std::uint8_t first = in.u8();
  if (!in.ok()) return fail(ErrorCode::BadStream, "region part: empty", 0);
  if ((first & 15) != kRegionPartVersion) {
    return fail(ErrorCode::Unsupported,
                "region part: version " + std::to_string(first & 15) + ", which this program does not know",
                0);
  }
  return RegionPartHeader{.has_turned = (first >> 4 & 1) != 0,
                          .has_anchors = (first >> 5 & 1) != 0,
                          .has_exact = (first >> 6 & 1) != 0,
                          .is_coarse = (first >> 7 & 1) != 0};
}

std::int32_t GridBox::extent() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }

int GridBox::offset_bits(int axis) const {
  return std::bit_width(static_cast<std::uint32_t>(high[axis] - low[axis]));
}

GridPoint drop_bits(const GridPoint& p, int dropped) {
  return {p.x >> dropped, p.y >> dropped, p.z >> dropped};
}

GridPoint restore_bits(const GridPoint& p, int dropped) {
  const std::int32_t middle = (1 << dropped) >> 1;
  return {(p.x << dropped) + middle, (p.y << dropped) + middle, (p.z << dropped) + middle};
}

std::vector<VertexId> anchor_order(const BoundaryLoops& loops, std::uint32_t vertex_count) {
  std::vector<VertexId> order = loops.vertices;
  std::vector<bool> is_on_loop(vertex_count, false);
  for (VertexId v : loops.vertices) is_on_loop[v] = true;
  for (VertexId v = 0; v < vertex_count; ++v) {
    if (!is_on_loop[v]) order.push_back(v);
  }
  return order;
}

}  // namespace selvage
