// SPDX-License-Identifier: MIT
#include "tests/golden/fuzz_seeds.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace selvage {
namespace {

/// Fuzzing goes best from small inputs.
constexpr std::size_t kLargestPart = 1024, kLargestPack = 3072;  // of one without levels
/// About so many regions of a pack, spread over it.
constexpr std::size_t kRegions = 6;

bool fits_u16(std::int64_t value) { return value >= 0 && value <= 0xffff; }

/// See tests/fuzz/fuzz_region.cpp.
std::optional<Bytes> region_seed(const Pack& pack, RegionId region, std::size_t level) {
  const Directory& directory = pack.directory();
  const RegionEntry& entry = directory.regions[region];
  const LevelEntry& at = entry.levels[level];
  ByteWriter out;
  bool fits = fits_u16(at.vertices) && fits_u16(at.triangles) && entry.loop_lengths.size() < 256;
  const auto u16 = [&](std::int64_t value) {
    fits = fits && fits_u16(value);
    out.u16(static_cast<std::uint16_t>(value));
  };
  u16(at.vertices);
  u16(at.triangles);
  out.u8(static_cast<std::uint8_t>((level == 0 && directory.is_exact ? 1 : 0) | (level > 0 ? 2 : 0)));
  for (int axis = 0; axis < 3; ++axis) u16(entry.box_min[axis]);
  for (int axis = 0; axis < 3; ++axis) u16(std::int64_t{entry.box_max[axis]} - entry.box_min[axis]);
  if (level > 0) {
    out.u8(at.dropped_bits);
    out.u8(static_cast<std::uint8_t>(entry.loop_lengths.size()));
    for (const std::uint32_t length : entry.loop_lengths) u16(length);
  }
  out.append(pack.part(at.part));
  if (!fits || at.part.size > kLargestPart) return std::nullopt;
  return std::move(out).take();
}

/// See tests/fuzz/fuzz_bundle.cpp.
std::optional<Bytes> bundle_seed(const Pack& pack, RegionId region) {
  const Directory& directory = pack.directory();
  const RegionEntry& entry = directory.regions[region];
  std::vector<RegionId> touched = entry.lower_neighbours;
  touched.push_back(region);
  bool fits = touched.size() <= 8 && fits_u16(entry.bundle_triangles) && entry.bundle.size <= kLargestPart;
  ByteWriter out;
  out.u8(static_cast<std::uint8_t>(touched.size() - 1));
  for (const RegionId id : touched) {
    const auto& lengths = directory.regions[id].loop_lengths;
    fits = fits && lengths.size() < 8 &&
           std::ranges::all_of(lengths, [](std::uint32_t length) { return length >= 1 && length <= 256; });
    out.u8(static_cast<std::uint8_t>(lengths.size()));
    for (const std::uint32_t length : lengths) out.u8(static_cast<std::uint8_t>(length - 1));
  }
  out.u16(static_cast<std::uint16_t>(entry.bundle_triangles));
  out.append(pack.part(entry.bundle));
  if (!fits) return std::nullopt;
  return std::move(out).take();
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
