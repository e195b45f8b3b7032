// SPDX-License-Identifier: MIT
//
// A region part behind what a directory would say of it: u16 vertices, u16 triangles, u8 exact, u16 box (low
// corner, then extents), the part.
#include <cstdlib>

#include "client/decode/region_decoder.h"
#include "common/coding/byte_io.h"
#include "common/mesh/check_corner_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  ByteReader in(std::as_bytes(std::span(data, size)));
  DecodeLimits expected;
  expected.vertices = in.u16();
  expected.triangles = in.u16();
  if (in.u8() & 1) expected.exact = Grid{.origin = {-1, 0, 1e-3}, .step = 1e-4, .bits = 24};
  for (int axis = 0; axis < 3; ++axis) expected.box_min[axis] = in.u16();
  for (int axis = 0; axis < 3; ++axis) expected.box_max[axis] = expected.box_min[axis] + in.u16();
  const auto region = decode_region(in.take(in.left()), expected);
  if (!region) return 0;
  const bool is_sound = check_corner_table(region->table) && region->positions.size() == expected.vertices &&
                        region->table.triangle_count() == expected.triangles;
  if (!is_sound) std::abort();
  return 0;
}
