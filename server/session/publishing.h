// SPDX-License-Identifier: MIT
//
// What a session needs of publishing, so that it need not know meshes: server/publish does the work behind
// it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/net/messages.h"

namespace selvage {

/// What becomes of an upload. Called from any thread, one call at a time; nothing after on_end.
struct PublishEvents {
  std::function<void(const PublishProgress&)> on_progress;
  std::function<void(Result<Published>)> on_end;
};

/// One mesh on its way in. Used by one session at a time. When it is destroyed before submit(), what has come
/// is kept for a while, so that the same Publish can go on from there; after submit() the work goes on.
class Upload {
 public:
  virtual ~Upload() = default;

  /// Bytes held so far: those that need not be sent (again).
  virtual std::uint64_t held() const = 0;

  /// Touches the disk. Cancelled if another connection has taken the upload over; Io.
  virtual Result<void> append(std::span<const std::byte> bytes) = 0;

  /// All bytes are there: queues the work. Unavailable if the queue is full; the upload then stays as it is.
  virtual Result<void> submit(PublishEvents events) = 0;

  /// Gives up: what has come is removed, work that has begun ends soon, with Cancelled.
  virtual void cancel() = 0;
};

/// Thread-safe. Calls touch the disk: keep them off I/O threads.
class Publishing {
 public:
  virtual ~Publishing() = default;

  /// `who`: for whom it is held, as in Access. InvalidArgument for a bad name or a format that is not read;
  /// LimitExceeded; NameInUse is InvalidArgument too, and says what to do.
  virtual Result<std::shared_ptr<Upload>> begin(const Publish& request, const std::string& who) = 0;

  /// NotFound if there is no such model. Who has it open keeps it.
  virtual Result<void> unpublish(const std::string& name) = 0;

  /// What is being ingested, then what waits for it, in order.
  virtual std::vector<PublishJob> jobs() const = 0;
};

}  // namespace selvage
