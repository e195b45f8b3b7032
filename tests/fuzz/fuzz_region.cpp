// SPDX-License-Identifier: MIT
//
// A region part behind what a directory would say of it, see part_input.h.
#include <cstdlib>

#include "tests/fuzz/part_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  const RegionInput input = read_region_input(std::as_bytes(std::span(data, size)));
  const auto region = decode_region(input.part, input.expected);
  if (!region) return 0;
  const bool is_sound = check_region_mesh(*region) && region->positions.size() == input.expected.vertices &&
                        region->triangles.size() == input.expected.triangles;
  if (!is_sound) std::abort();
  return 0;
}
