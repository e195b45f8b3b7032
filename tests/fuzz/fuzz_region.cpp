// SPDX-License-Identifier: MIT
//
// A region part behind what a directory would say of it: u16 vertices, u16 triangles, u8 flags (1 exact, 2
// coarser level), u16 box (low corner, then extents), of a coarser level u8 dropped bits, u8 number of loops
// and their lengths as u16, the part.
#include <cstdlib>
#include <vector>

#include "client/decode/region_decoder.h"
#include "common/coding/byte_io.h"
#include "common/mesh/check_corner_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  ByteReader in(std::as_bytes(std::span(data, size)));
  DecodeLimits expected;
  expected.vertices = in.u16();
  expected.triangles = in.u16();
  const std::uint8_t flags = in.u8();
  if (flags & 1) expected.exact = Grid{.origin = {-1, 0, 1e-3}, .step = 1e-4, .bits = 24};
  for (int axis = 0; axis < 3; ++axis) expected.box_min[axis] = in.u16();
  for (int axis = 0; axis < 3; ++axis) expected.box_max[axis] = expected.box_min[axis] + in.u16();
  std::vector<std::uint32_t> loops;
  if (flags & 2) {
    const int dropped_bits = in.u8() % 16;
    loops.resize(in.u8());
    for (std::uint32_t& length : loops) length = in.u16();
    expected.coarse = CoarseLevel{loops, dropped_bits};
  }
  const auto region = decode_region(in.take(in.left()), expected);
  if (!region) return 0;
  const bool is_sound = check_corner_table(region->table) && region->positions.size() == expected.vertices &&
                        region->table.triangle_count() == expected.triangles;
  if (!is_sound) std::abort();
  for (const VertexId v : region->vertex_of_boundary) {
    if (v >= expected.vertices) std::abort();
  }
  return 0;
}
