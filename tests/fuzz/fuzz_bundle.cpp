// SPDX-License-Identifier: MIT
//
// A bundle part behind what a directory would say of it, see part_input.h.
#include <cstdlib>

#include "tests/fuzz/part_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  const BundleInput input = read_bundle_input(std::as_bytes(std::span(data, size)));
  const BundleTopology topology = input.topology();
  const auto decoded = decode_bundle(input.part, topology, input.triangles);
  if (!decoded) return 0;
  if (decoded->size() != input.triangles) std::abort();
  for (const BoundaryTriangle& triangle : *decoded) {
    for (const BoundaryRef& corner : triangle.corners) {
      const std::uint32_t slot = topology.slot_of_region(corner.region);
      if (slot == kNone || corner.index >= topology.vertex_count(slot)) std::abort();
    }
  }
  return 0;
}
