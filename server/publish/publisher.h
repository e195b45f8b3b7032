// SPDX-License-Identifier: MIT
//
// Takes uploads, and turns them into models one after the other on a thread of its own, so that publishing
// never takes more of the machine than it was given.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "server/publish/staging.h"
#include "server/session/counters.h"
#include "server/session/publishing.h"
#include "server/store/pack_store.h"

namespace selvage {

struct PublishLimits {
  std::uint64_t upload_bytes = 256u << 20;     ///< of one mesh file
  std::uint64_t staged_bytes = 1024u << 20;    ///< of all that is being uploaded, or waits to be resumed
  std::chrono::seconds staged_age{24 * 3600};  ///< an upload that nobody resumes for so long is removed
  std::uint32_t queue = 8;                     ///< whole uploads that wait for their turn
  unsigned threads = 1;                        ///< that ingest one model
};

/// Thread-safe. Work under way is cancelled when it is destroyed; what was uploaded stays for another time.
class Publisher final : public Publishing {
 public:
  /// `store` and `counters` outlive it.
  Publisher(PackStore& store, ServerCounters& counters, const PublishLimits& limits);
  ~Publisher() override;

  Result<std::shared_ptr<Upload>> begin(const Publish& request, const std::string& who) override;
  Result<void> unpublish(const std::string& name) override;
  std::vector<PublishJob> jobs() const override;

 private:
  class MeshUpload;
  class DoneUpload;
  /// A whole upload that waits or is being worked on.
  struct Job {
    Publish request;
    std::string key;
    std::unique_ptr<StagedFile> file;
    PublishEvents events;  ///< of the last connection that asked
    std::atomic<bool> is_cancelled = false;
    PublishProgress progress;
    std::chrono::steady_clock::time_point told;
  };

  Result<void> check(const Publish& request) const;
  Result<std::shared_ptr<Upload>> resume(const Publish& request, std::string key);
  Result<void> submit(std::shared_ptr<Job> job);
  void cancel(Job& job);

  void work(std::stop_token stop);
  std::shared_ptr<Job> wait_for_job(std::stop_token stop);
  Result<Published> do_job(Job& job, std::stop_token stop);
  bool note_progress(Job& job, const std::string& stage, double done);
  void finish(const std::shared_ptr<Job>& job, Result<Published> outcome);

  PackStore& store_;
  ServerCounters& counters_;
  const PublishLimits limits_;

  mutable std::mutex mutex_;  ///< guards all below
  std::condition_variable_any changed_;
  StagingFolder staging_;
  std::map<std::string, std::weak_ptr<MeshUpload>> uploads_;  ///< by key, those that connections hold
  std::deque<std::shared_ptr<Job>> jobs_;  ///< the first is being worked on, unless it is just about to be
  std::jthread worker_;                    ///< last: uses the rest
};

}  // namespace selvage
