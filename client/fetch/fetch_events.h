// SPDX-License-Identifier: MIT
//
// What a fetch tells while it runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "client/stitch/stitch_update.h"
#include "common/base/result.h"

namespace selvage {

/// What has come of a fetch so far. Parts are regions, one level each, and bundles of joins. How much there
/// is in all may become known on the way: the numbers are 0 before.
struct FetchProgress {
  std::uint32_t regions = 0, of_regions = 0;  ///< decoded, and in all
  std::uint32_t parts = 0, of_parts = 0;      ///< arrived, and in all
  std::uint64_t bytes = 0, of_bytes = 0;      ///< of those parts
};

/// A region was decoded; the next update has it.
struct ArrivedRegion {
  RegionId region = 0;
  std::uint8_t level = 0;
  std::uint32_t vertices = 0, triangles = 0;  ///< without the triangles that join it to its neighbours
};

/// Any of these may be left out. They are called one at a time, on threads of the library or on the one that
/// waits for the fetch, and should be quick; they may cancel or reprioritise their fetch, and must not wait
/// for it or destroy it.
struct FetchEvents {
  std::function<void(const ArrivedRegion&)> on_region;
  /// What has changed in the stitched mesh, never nothing: after the first part, then at most every
  /// `update_interval`, and at last with the rest, however the fetch ends. Whoever applies every update has
  /// the mesh. Costs time in proportion to what has changed, not to what is there.
  std::function<void(const StitchUpdate&)> on_update;
  std::chrono::milliseconds update_interval{100};
  std::function<void(const FetchProgress&)> on_progress;
  /// A failure that may pass, and how long the fetch waits before it tries again.
  std::function<void(const Error&, std::chrono::milliseconds)> on_retry;
};

}  // namespace selvage
