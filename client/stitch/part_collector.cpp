// SPDX-License-Identifier: MIT
#include "client/stitch/part_collector.h"

#include <optional>
#include <string>

#include "client/decode/bundle_decoder.h"
#include "client/decode/region_decoder.h"
#include "client/stitch/decode_limits.h"

namespace selvage {

PartCollector::PartCollector(const Directory& directory) : directory_(directory), stitcher_(directory) {}
PartCollector::~PartCollector() = default;

Result<void> PartCollector::add(const PartId& id, std::span<const std::byte> bytes) {
  if (directory_.find(id) == nullptr)
    return fail(ErrorCode::BadStream, "a part that the directory does not list");
  const bool is_region = id.kind == PartKind::Region;
  auto ok = is_region ? add_region(id.region, id.level, bytes) : add_bundle(id.region, bytes);
  if (!ok) return forward_error(ok, (is_region ? "region " : "bundle ") + std::to_string(id.region));
  return {};
}

Result<void> PartCollector::add_region(RegionId region, std::uint8_t level,
                                       std::span<const std::byte> bytes) {
  auto decoder = take_decoder();
  auto mesh = decoder->decode(bytes, decode_limits(directory_, region, level));
  give_back(std::move(decoder));
  if (!mesh) return forward_error(mesh);
  const std::scoped_lock lock(mutex_);
  return stitcher_.add_region(region, std::move(*mesh), level);
}

Result<void> PartCollector::add_bundle(RegionId region, std::span<const std::byte> bytes) {
  const RegionEntry& entry = directory_.regions[region];
  std::vector<BundleTopology::Region> regions;
  for (RegionId id : entry.lower_neighbours) regions.push_back({id, directory_.regions[id].loop_lengths});
  regions.push_back({region, entry.loop_lengths});
  auto triangles = decode_bundle(bytes, BundleTopology(std::move(regions)), entry.bundle_triangles);
  if (!triangles) return forward_error(triangles);
  const std::scoped_lock lock(mutex_);
  return stitcher_.add_bundle(region, std::move(*triangles));
}

std::unique_ptr<RegionDecoder> PartCollector::take_decoder() {
  const std::scoped_lock lock(mutex_);
  if (idle_decoders_.empty()) return std::make_unique<RegionDecoder>();
  auto decoder = std::move(idle_decoders_.back());
  idle_decoders_.pop_back();
  return decoder;
}

void PartCollector::give_back(std::unique_ptr<RegionDecoder> decoder) {
  const std::scoped_lock lock(mutex_);
  idle_decoders_.push_back(std::move(decoder));
}

void PartCollector::remove_region(RegionId region) {
  const std::scoped_lock lock(mutex_);
  stitcher_.remove_region(region);
}

StitchUpdate PartCollector::take_update() {
  const std::scoped_lock lock(mutex_);
  return stitcher_.take_update();
}

StitchedMesh PartCollector::mesh() const {
  const std::scoped_lock lock(mutex_);
  return stitcher_.mesh();
}

std::vector<RegionId> PartCollector::regions() const {
  const std::scoped_lock lock(mutex_);
  return stitcher_.regions();
}

std::optional<std::uint8_t> PartCollector::level_of(RegionId region) const {
  const std::scoped_lock lock(mutex_);
  return stitcher_.level_of(region);
}

}  // namespace selvage
