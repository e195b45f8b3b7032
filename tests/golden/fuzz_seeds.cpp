// SPDX-License-Identifier: MIT
#include "tests/golden/fuzz_seeds.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/fuzz/part_input.h"

namespace selvage {
namespace {

/// Fuzzing goes best from small inputs.
constexpr std::size_t kLargestPart = 1024, kLargestPack = 3072;  // of one without levels
/// About so many regions of a pack, spread over it.
constexpr std::size_t kRegions = 6;

std::optional<Bytes> region_seed(const Pack& pack, RegionId region, std::size_t level) {
  const Directory& directory = pack.directory();
  const RegionEntry& entry = directory.regions[region];
  const LevelEntry& at = entry.levels[level];
  RegionInput input;
  input.expected = {at.vertices, at.triangles, entry.box_min, entry.box_max};
  if (level == 0 && directory.is_exact) input.expected.exact = kExactInputGrid;
  if (level > 0) {
    input.loops = entry.loop_lengths;
    input.expected.coarse = CoarseLevel{input.loops, at.dropped_bits};
  }
  input.part = pack.part(at.part);
  return at.part.size <= kLargestPart ? write_region_input(input) : std::nullopt;
}

std::optional<Bytes> bundle_seed(const Pack& pack, RegionId region) {
  const Directory& directory = pack.directory();
  const RegionEntry& entry = directory.regions[region];
  BundleInput input;
  for (const RegionId id : entry.lower_neighbours) input.loops.push_back(directory.regions[id].loop_lengths);
  input.loops.push_back(entry.loop_lengths);
  input.triangles = entry.bundle_triangles;
  input.part = pack.part(entry.bundle);
  return entry.bundle.size <= kLargestPart ? write_bundle_input(input) : std::nullopt;
}

}  // namespace

std::map<std::string, Bytes> fuzz_seeds(const Pack& pack, const std::string& name) {
  std::map<std::string, Bytes> seeds;
  const auto keep = [&](const std::string& key, std::optional<Bytes> bytes) {
    if (bytes) seeds.emplace(key, std::move(*bytes));
  };
  if (pack.bytes().size() <= kLargestPack || pack.directory().level_count() > 1) {
    seeds.emplace("fuzz_pack/" + name, Bytes(pack.bytes().begin(), pack.bytes().end()));
  }
  const Directory& directory = pack.directory();
  const auto step = std::max<std::size_t>(1, directory.regions.size() / kRegions);
  for (RegionId region = 0; region < directory.regions.size(); region += static_cast<RegionId>(step)) {
    const RegionEntry& entry = directory.regions[region];
    const std::string number = std::to_string(region);
    for (std::size_t level = 0; level < entry.levels.size(); ++level) {
      if (region == kLooseRegion || entry.levels[level].is_repeat) continue;
      keep("fuzz_region/" + name + number + "at" + std::to_string(level), region_seed(pack, region, level));
    }
    if (entry.bundle.size > 0) keep("fuzz_bundle/" + name + number, bundle_seed(pack, region));
  }
  return seeds;
}

}  // namespace selvage
