// SPDX-License-Identifier: MIT
//
// A bundle part behind what a directory would say of it: u8 regions, for each a u8 number of loops and a u8
// length for each loop, u16 triangles, the part.
#include <cstdlib>
#include <span>
#include <vector>

#include "client/decode/bundle_decoder.h"
#include "common/coding/byte_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  ByteReader in(std::as_bytes(std::span(data, size)));
  std::vector<std::vector<std::uint32_t>> loops(1 + in.u8() % 8);
  for (auto& lengths : loops) {
    lengths.resize(in.u8() % 8);
    for (std::uint32_t& length : lengths) length = 1 + in.u8();
  }
  const std::uint32_t triangles = in.u16();
  std::vector<BundleTopology::Region> regions;
  for (std::size_t i = 0; i < loops.size(); ++i) regions.push_back({static_cast<RegionId>(i + 1), loops[i]});
  const BundleTopology topology(std::move(regions));
  const auto decoded = decode_bundle(in.take(in.left()), topology, triangles);
  if (!decoded) return 0;
  if (decoded->size() != triangles) std::abort();
  for (const BoundaryTriangle& triangle : *decoded) {
    for (const BoundaryRef& corner : triangle.corners) {
      const std::uint32_t slot = topology.slot_of_region(corner.region);
      if (slot == kNone || corner.index >= topology.vertex_count(slot)) std::abort();
    }
  }
  return 0;
}
