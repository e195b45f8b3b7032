// SPDX-License-Identifier: MIT
#include "server/publish/publisher.h"

#include <algorithm>

#include "common/base/hash.h"
#include "common/base/log.h"
#include "common/base/replace_file.h"
#include "common/mesh_io/read_mesh.h"
#include "server/publish/publish_mesh.h"
#include "server/publish/publish_options.h"

namespace selvage {
namespace {

/// A publisher hears of progress this often at most, and of every new stage.
constexpr std::chrono::milliseconds kProgressInterval{200};

constexpr const char* kStagingFolder = ".uploads";

/// The same upload from the same publisher has the same key, so that it can be resumed: on any connection,
/// and by a server started anew.
std::string key_of(const Publish& request, const std::string& who) {
  std::string all;
  for (const std::string& part :
       {who, request.name, request.hash.to_hex(), std::to_string(request.size_bytes), request.units,
        std::to_string(request.bits), std::string(request.lossless ? "lossless" : ""),
        to_text(request.cut)}) {
    all += std::to_string(part.size()) + ':' + part;
  }
  return hash_of(std::as_bytes(std::span(all))).to_hex() +
         std::filesystem::path(request.file).extension().string();
}

tl::unexpected<Error> cancelled() { return fail(ErrorCode::Cancelled, "cancelled"); }

}  // namespace

/// An upload that a connection holds: first a file that grows, then a job.
class Publisher::MeshUpload final : public Upload {
 public:
  MeshUpload(Publisher& publisher, std::shared_ptr<Job> job) : publisher_(publisher), job_(std::move(job)) {}

  std::uint64_t held() const override {
    const std::lock_guard lock(mutex_);
    return job_->file->size();
  }

  Result<void> append(std::span<const std::byte> bytes) override {
    const std::lock_guard lock(mutex_);
    if (is_over_) return fail(ErrorCode::Cancelled, "another connection goes on with this upload");
    if (bytes.size() > job_->request.size_bytes - job_->file->size()) {
      return fail(ErrorCode::InvalidArgument, "more bytes than were announced");
    }
    publisher_.counters_.bytes_uploaded += bytes.size();
    return job_->file->append(bytes);
  }

  Result<void> submit(PublishEvents events) override {
    {
      const std::lock_guard lock(mutex_);
      if (is_over_) return fail(ErrorCode::Cancelled, "another connection goes on with this upload");
      if (job_->file->size() != job_->request.size_bytes) {
        return fail(ErrorCode::InvalidArgument, "fewer bytes than were announced");
      }
    }
    {
      const std::lock_guard lock(publisher_.mutex_);
      const PublishEvents earlier = std::exchange(job_->events, std::move(events));
      if (earlier.on_end)
        earlier.on_end(fail(ErrorCode::Cancelled, "another connection waits for this model now"));
    }
    return publisher_.submit(job_);
  }

  void cancel() override {
    end();
    publisher_.cancel(*job_);
  }

  /// Another connection has the upload now.
  void end() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }

 private:
  Publisher& publisher_;
  const std::shared_ptr<Job> job_;
  mutable std::mutex mutex_;
  bool is_over_ = false;
};

/// A request whose model is in the store already: the publisher lost the connection before it heard of it.
class Publisher::DoneUpload final : public Upload {
 public:
  DoneUpload(std::uint64_t size, Published published) : size_(size), published_(std::move(published)) {}
  std::uint64_t held() const override { return size_; }
  Result<void> append(std::span<const std::byte>) override {
    return fail(ErrorCode::InvalidArgument, "more bytes than were announced");
  }
  Result<void> submit(PublishEvents events) override {
    events.on_end(published_);
    return {};
  }
  void cancel() override {}

 private:
  std::uint64_t size_;
  Published published_;
};

Publisher::Publisher(PackStore& store, ServerCounters& counters, const PublishLimits& limits)
    : store_(store),
      counters_(counters),
      limits_(limits),
      staging_(store.folder() / kStagingFolder),
      worker_([this](std::stop_token stop) { work(stop); }) {}

Publisher::~Publisher() = default;

// ---- uploads

Result<void> Publisher::check(const Publish& request) const {
  if (!is_model_name(request.name)) {
    return fail(ErrorCode::InvalidArgument,
                "'" + request.name + "' is no name for a model; leave out slashes and a leading dot");
  }
  if (!is_mesh_file_name(request.file)) {
    return fail(ErrorCode::InvalidArgument,
                request.file + ": not a format that is read; .ply .obj .off .stl .wrl and .om are");
  }
  if (request.size_bytes > limits_.upload_bytes) {
    return fail(ErrorCode::LimitExceeded, request.file + ": larger than the " +
                                              std::to_string(limits_.upload_bytes) +
                                              " bytes that this server takes");
  }
  return {};
}

Result<std::shared_ptr<Upload>> Publisher::begin(const Publish& request, const std::string& who) {
  if (auto ok = check(request); !ok) return forward_error(ok);
  const auto existing = store_.open(request.name);
  if (existing && is_result_of((*existing)->directory(), request)) {
    // A server that was killed between its last two steps has left the upload.
    const std::string key = key_of(request, who);
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(jobs_, key, [](const auto& job) { return job->key; }) == jobs_.end()) {
      staging_.remove(key);
    }
    return std::make_shared<DoneUpload>(request.size_bytes, describe(request, **existing));
  }
  // A damaged pack has the name, too.
  const bool is_free = !existing && existing.error().code == ErrorCode::NotFound;
  if (!is_free && !request.replace) return tl::unexpected(name_in_use(request.name));
  return resume(request, key_of(request, who));
}

Result<std::shared_ptr<Upload>> Publisher::resume(const Publish& request, std::string key) {
  const std::lock_guard lock(mutex_);
  staging_.remove_older_than(limits_.staged_age);
  if (const auto held = uploads_[key].lock()) held->end();

  const auto running = std::ranges::find(jobs_, key, [](const auto& job) { return job->key; });
  std::shared_ptr<Job> job;
  if (running != jobs_.end()) {
    job = *running;
  } else {
    if (staging_.bytes_except(key) + request.size_bytes > limits_.staged_bytes) {
      return fail(ErrorCode::Unavailable, "the server has no room for more uploads; try again later");
    }
    auto file = staging_.open(key, request.size_bytes);
    if (!file) return forward_error(file);
    job = std::make_shared<Job>();
    job->request = request;
    job->key = key;
    job->file = std::move(*file);
  }
  auto upload = std::make_shared<MeshUpload>(*this, std::move(job));
  uploads_[key] = upload;
  std::erase_if(uploads_, [](const auto& entry) { return entry.second.expired(); });
  return upload;
}

Result<void> Publisher::submit(std::shared_ptr<Job> job) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(jobs_, job) != jobs_.end()) return {};  // asked for again, on another connection
  if (jobs_.size() > limits_.queue) {
    return fail(ErrorCode::Unavailable, "too many models wait to be published; try again later");
  }
  job->progress = {"wait", 0, static_cast<std::uint32_t>(jobs_.size())};
  job->events.on_progress(job->progress);
  jobs_.push_back(std::move(job));
  changed_.notify_one();
  return {};
}

void Publisher::cancel(Job& job) {
  const std::lock_guard lock(mutex_);
  job.is_cancelled = true;
  const auto at = std::ranges::find(jobs_, &job, [](const auto& other) { return other.get(); });
  if (at != jobs_.end() && at == jobs_.begin()) return;  // the worker notices
  if (at != jobs_.end()) {
    job.events.on_end(cancelled());
    jobs_.erase(at);
  }
  staging_.remove(job.key);
}

Result<void> Publisher::unpublish(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return store_.remove(name);
}

std::vector<PublishJob> Publisher::jobs() const {
  const std::lock_guard lock(mutex_);
  std::vector<PublishJob> all;
  for (const auto& job : jobs_)
    all.push_back({job->request.name, job->progress.stage, job->progress.permille});
  return all;
}

// ---- work

void Publisher::work(std::stop_token stop) {
  while (const std::shared_ptr<Job> job = wait_for_job(stop)) {
    Result<Published> outcome = do_job(*job, stop);
    if (stop.stop_requested()) return;  // the upload stays: whoever comes back finds it
    finish(job, std::move(outcome));
  }
}

std::shared_ptr<Publisher::Job> Publisher::wait_for_job(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [&] { return !jobs_.empty(); })) return nullptr;
  return stop.stop_requested() ? nullptr : jobs_.front();
}

Result<Published> Publisher::do_job(Job& job, std::stop_token stop) {
  PublishPaths paths;
  {
    const std::lock_guard lock(mutex_);
    if (job.is_cancelled) return cancelled();
    paths = {job.file->path(), staging_.pack_path(job.key), store_.path_of(job.request.name)};
  }
  const auto progress = [&](const std::string& stage, double done) {
    return note_progress(job, stage, done) && !stop.stop_requested();
  };
  try {
    auto published = publish_mesh(job.request, paths, threaded_for(limits_.threads), progress);
    if (published) (void)store_.open(job.request.name);  // so that status and log know of it at once
    return published;
  } catch (const std::exception& exception) {  // ours: a mesh must not bring the server down
    return fail(ErrorCode::Unsupported, job.request.file + ": " + exception.what());
  }
}

bool Publisher::note_progress(Job& job, const std::string& stage, double done) {
  const auto now = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  const bool is_news = stage != job.progress.stage || now - job.told >= kProgressInterval;
  if (is_news && !job.is_cancelled) {
    job.told = now;
    job.progress = {stage, static_cast<std::uint32_t>(1000 * std::clamp(done, 0.0, 1.0)), 0};
    const auto tell = job.events.on_progress;
    const PublishProgress progress = job.progress;
    lock.unlock();
    tell(progress);
  }
  return !job.is_cancelled;
}

/// An upload that failed for its own sake is of no further use; one that the server could not keep stays.
void Publisher::finish(const std::shared_ptr<Job>& job, Result<Published> outcome) {
  if (outcome) {
    log(LogLevel::Info, "published",
        {{"model", job->request.name}, {"bytes", std::to_string(outcome->size_bytes)}});
    ++counters_.published;
  } else {
    log(LogLevel::Info, "not published", {{"model", job->request.name}, {"reason", outcome.error().message}});
    ++counters_.publish_failed;
  }
  PublishEvents events;
  {
    const std::lock_guard lock(mutex_);
    std::erase(jobs_, job);
    if (outcome || outcome.error().code != ErrorCode::Io) staging_.remove(job->key);
    events = std::move(job->events);
  }
  events.on_end(std::move(outcome));
}

}  // namespace selvage
