// SPDX-License-Identifier: MIT
//
// A region part behind what a directory would say of it, see part_input.h.
#include <cstdlib>

#include "common/mesh/check_corner_table.h"
#include "tests/fuzz/part_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  const RegionInput input = read_region_input(std::as_bytes(std::span(data, size)));
  const auto region = decode_region(input.part, input.expected);
  if (!region) return 0;
  const bool is_sound = check_corner_table(region->table) &&
                        region->positions.size() == input.expected.vertices &&
                        region->table.triangle_count() == input.expected.triangles;
  if (!is_sound) std::abort();
  for (const VertexId v : region->vertex_of_boundary) {
    if (v >= input.expected.vertices) std::abort();
  }
  return 0;
}
