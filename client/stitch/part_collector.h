// SPDX-License-Identifier: MIT
//
// From a part's bytes to the stitcher: decodes each as it comes, on whatever thread it comes.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "client/stitch/stitcher.h"

namespace selvage {

class RegionDecoder;

/// Thread-safe: parts decode at the same time, only adding them to the stitcher is one at a time. Of two
/// levels of one region the one added last is shown.
class PartCollector {
 public:
  /// `directory` is borrowed and must outlive the collector.
  explicit PartCollector(const Directory& directory);
  ~PartCollector();

  /// Decodes a part whose hash was checked. BadStream names the part that is malformed.
  Result<void> add(const PartId& id, std::span<const std::byte> bytes);

  void remove_region(RegionId region);

  StitchUpdate take_update();
  StitchedMesh mesh() const;
  std::vector<RegionId> regions() const;  ///< that are there, ascending
  /// Nothing if the region is not there.
  std::optional<std::uint8_t> level_of(RegionId region) const;

 private:
  Result<void> add_region(RegionId region, std::uint8_t level, std::span<const std::byte> bytes);
  Result<void> add_bundle(RegionId region, std::span<const std::byte> bytes);

  /// Decoders keep their memory from region to region; as many are made as work at the same time.
  std::unique_ptr<RegionDecoder> take_decoder();
  void give_back(std::unique_ptr<RegionDecoder> decoder);

  const Directory& directory_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<RegionDecoder>> idle_decoders_;
  Stitcher stitcher_;
};

}  // namespace selvage
