// SPDX-License-Identifier: MIT
#include "common/codec/region_format.h"

#include "common/mesh/grid.h"

namespace selvage {

void write_region_header(ByteWriter& out, const RegionPartHeader& header) {
  out.u8(static_cast<std::uint8_t>(kRegionPartVersion | header.has_turned << 4 | header.has_anchors << 5));
  out.u8(static_cast<std::uint8_t>(header.bits));
  out.varint(header.symbols);
  out.varint(header.connectivity_size);
}

Result<RegionPartHeader> read_region_header(ByteReader& in) {
  const std::uint8_t first = in.u8();
  RegionPartHeader header;
  header.has_turned = first >> 4 & 1;
  header.has_anchors = first >> 5 & 1;
  header.bits = in.u8();
  header.symbols = in.varint32();
  header.connectivity_size = in.varint32();
  if (!in.ok() || header.connectivity_size > in.left())
    return fail(ErrorCode::BadStream, "region part: truncated header", in.offset());
  if ((first & 15) != kRegionPartVersion || first >> 6 != 0) {
    return fail(
        ErrorCode::Unsupported,
        "region part: version " + std::to_string(first & 15) + " with flags this program does not know", 0);
  }
  if (header.bits < kMinGridBits || header.bits > kMaxGridBits)
    return fail(ErrorCode::BadStream, "region part: grid bits out of range", 1);
  if ((header.symbols == 0) != (header.connectivity_size == 0))
    return fail(ErrorCode::BadStream, "region part: symbols without a stream", 2);
  return header;
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
