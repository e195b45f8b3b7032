// SPDX-License-Identifier: MIT
//
// A pack whose parts are arbitrary bytes: for tests of everything that must not look inside parts.
#pragma once

#include <string>

#include "common/coding/byte_io.h"
#include "common/pack/pack.h"

namespace selvage {

/// Regions 1..count in a row: region r touches r - 1, its box is [r, r + 1] on x, its part is `part_size`
/// bytes.
inline Bytes fake_pack_bytes(std::uint32_t count, std::uint32_t part_size = 100,
                             const std::string& name = "row") {
  Directory directory;
  directory.name = name;
  directory.grid = Grid{.origin = {0, 0, 0}, .step = 1, .bits = 16};
  directory.regions.resize(count + 1);
  directory.regions[kLooseRegion].loop_lengths = {};
  std::vector<Bytes> parts;
  for (RegionId id = 1; id <= count; ++id) {
    RegionEntry& entry = directory.regions[id];
    const auto at = static_cast<std::int32_t>(id);
    entry.box_min = {at, 0, 0};
    entry.box_max = {at + 1, 1, 1};
    entry.loop_lengths = {4};
    entry.levels.push_back({.vertices = 5, .triangles = 4});
    Bytes part(part_size);
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<std::byte>(i * 7 + id);
    parts.push_back(part);
    if (id == 1) continue;
    entry.lower_neighbours = {id - 1};
    entry.bundle_triangles = 8;
    parts.push_back(Bytes(3, static_cast<std::byte>(id)));
  }
  directory.vertices = 5 * count;
  directory.boundary_triangles = 8 * (count - 1);
  directory.triangles = 4 * count + directory.boundary_triangles;
  return assemble_pack(std::move(directory), parts);
}

}  // namespace selvage
