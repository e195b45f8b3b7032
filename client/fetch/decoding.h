// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "client/session/get_request.h"
#include "client/stitch/part_collector.h"
#include "common/base/task_group.h"

namespace selvage {

/// Decodes parts on worker threads, beside the thread that receives them, and adds them to a collector. The
/// queue is bounded: while it is full, who brings a part decodes it himself.
class Decoding {
 public:
  /// Called with each part that was added to the collector, on the thread that decoded it.
  using OnDecoded = std::function<void(const PartId&)>;

  /// `collector` is borrowed. `threads` 0: as many as the machine has.
  Decoding(PartCollector& collector, unsigned threads, OnDecoded on_decoded);
  ~Decoding() { drop_the_rest(); }
  Decoding(const Decoding&) = delete;
  Decoding& operator=(const Decoding&) = delete;

  /// Fails once a part could not be decoded, with the first of those errors. A part lives until it is
  /// decoded: its receipt is what lets the sender send more.
  Result<void> add(ReceivedPart part);

  void drop_the_rest() { is_over_ = true; }  ///< what has not begun is not needed any more

  /// Waits for what is left; the first error.
  Result<void> finish();

 private:
  void decode(const ReceivedPart& part);
  Result<void> failure() const;

  PartCollector& collector_;
  const OnDecoded on_decoded_;
  std::atomic<std::uint64_t> queued_bytes_ = 0;
  std::atomic<bool> is_over_ = false;  ///< nothing more needs decoding
  mutable std::mutex mutex_;
  std::optional<Error> failure_;
  TaskGroup tasks_;  // last: its tasks use the rest
};

}  // namespace selvage
