// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "client/fetch/decoding.h"
#include "client/fetch/fetch_events.h"
#include "client/fetch/missing_parts.h"
#include "client/stitch/part_collector.h"
#include "common/pack/directory.h"

namespace selvage {

/// A fetch while it runs: decodes what arrives, and tells of it. Parts come on one thread.
class Showing {
 public:
  using Clock = std::chrono::steady_clock;

  /// All but the number of threads is borrowed.
  Showing(const Directory& directory, PartCollector& collector, const FetchEvents& events, unsigned threads);

  /// What is to come in all, once that is known.
  void expect(const MissingParts& missing);
  /// Fails once a part could not be decoded.
  Result<void> add(ReceivedPart part);
  void tell_retry(const Error& error, std::chrono::milliseconds delay);
  /// Waits for what is left to decode, if it is needed, and tells the rest. The first part's failure.
  Result<void> finish(bool is_needed);

  // Once it has finished.
  const std::vector<RegionId>& bundles() const { return bundles_; }  ///< whose bundles were decoded
  std::uint32_t regions() const { return progress_.regions; }
  std::optional<Clock::time_point> first_region() const { return first_region_; }

 private:
  void note_decoded(const PartId& id);
  void tell_progress();
  void tell_region(const PartId& id);
  void tell_update(Clock::time_point now);

  const Directory& directory_;
  PartCollector& collector_;
  const FetchEvents& events_;

  std::mutex mutex_;  ///< of what follows
  FetchProgress progress_;
  std::vector<RegionId> bundles_;
  std::optional<Clock::time_point> first_region_;

  std::mutex telling_;  ///< held while an event runs; taken before mutex_
  std::optional<Clock::time_point> last_update_;

  Decoding decoding_;  // last: it uses the rest
};

}  // namespace selvage
