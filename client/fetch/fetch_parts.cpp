// SPDX-License-Identifier: MIT
#include "client/fetch/fetch_parts.h"

#include <condition_variable>
#include <mutex>

#include "client/fetch/missing_parts.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// False if `stop` came first.
bool sleep_for(milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wakes;
  std::unique_lock lock(mutex);
  wakes.wait_for(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

/// Waits between tries, and knows when to give up.
class Retrying {
 public:
  explicit Retrying(const FetchPartsOptions& options)
      : options_(options), backoff_(options.retry, std::random_device()()) {}

  void note_progress() { failing_since_.reset(), backoff_.reset(); }

  /// Waits; false if this error is the last word.
  bool try_again(const Error& error, const std::stop_token& stop) {
    if (!may_pass(error) || stop.stop_requested()) return false;
    const auto now = Clock::now();
    if (!failing_since_) failing_since_ = now;
    const milliseconds delay = backoff_.next();
    if (now - *failing_since_ + delay > options_.retry.give_up_after) return false;
    if (options_.on_retry) options_.on_retry(error, delay);
    return sleep_for(delay, stop);
  }

 private:
  const FetchPartsOptions& options_;
  Backoff backoff_;
  std::optional<Clock::time_point> failing_since_;
};

std::uint64_t size_of(const UnfinishedParts& parts) {
  std::uint64_t bytes = 0;
  for (const auto& [hash, front] : parts) bytes += front.size();
  return bytes;
}

Result<void> take_cached(PartCache& cache, const Directory& directory, MissingParts& missing,
                         const PartSource::OnPart& on_part, FetchPartsStats& stats) {
  const std::vector<PartId> ids(missing.ids().begin(), missing.ids().end());
  for (const PartId& id : ids) {
    auto bytes = cache.find(*directory.find(id));
    if (!bytes) continue;
    missing.take(id);
    ++stats.cached_parts;
    stats.cached_bytes += bytes->size();
    auto taken = on_part({id, std::move(*bytes), {}});
    if (!taken) return forward_error(taken);
  }
  return {};
}

}  // namespace

bool may_pass(const Error& error) {
  return error.code == ErrorCode::Io || error.code == ErrorCode::Unavailable ||
         error.code == ErrorCode::Timeout;
}

Result<FetchPartsStats> fetch_parts(PartSource& source, GetRequest request, const PartSource::OnPart& on_part,
                                    const FetchPartsOptions& options, std::stop_token stop) {
  const Directory& directory = request.manifest->directory;
  auto missing = MissingParts::of(directory, request.selection);
  if (!missing) return forward_error(missing);
  FetchPartsStats stats;
  if (options.cache != nullptr) {
    auto ok = take_cached(*options.cache, directory, *missing, on_part, stats);
    if (!ok) return forward_error(ok);
  }

  bool is_refused = false;  // by on_part: no try will help
  const auto take = [&](ReceivedPart part) -> Result<void> {
    if (!missing->take(part.id)) return {};  // came twice, because a request can hold only so many hashes
    if (options.cache != nullptr) options.cache->put(directory.find(part.id)->hash, part.bytes);
    ++stats.parts;
    stats.bytes += part.bytes.size();
    auto taken = on_part(std::move(part));
    is_refused = !taken;
    return taken;
  };
  request.unfinished = std::make_shared<UnfinishedParts>();
  Retrying retrying(options);
  while (!missing->empty()) {
    request.have = missing->held();
    const std::uint64_t before = stats.bytes + size_of(*request.unfinished);
    const auto outcome = source.get(request, take, stop);
    if (outcome) break;
    if (stats.bytes + size_of(*request.unfinished) > before) retrying.note_progress();
    if (is_refused || !retrying.try_again(outcome.error(), stop)) return tl::unexpected(outcome.error());
    ++stats.retries;
  }
  if (!missing->empty()) {
    return fail(ErrorCode::BadStream,
                std::to_string(missing->ids().size()) + " parts of the answer did not come");
  }
  return stats;
}

Result<std::shared_ptr<const Manifest>> open_with_retries(PartSource& source,
                                                          const FetchPartsOptions& options,
                                                          std::stop_token stop) {
  Retrying retrying(options);
  for (;;) {
    auto manifest = source.open(stop);
    if (manifest || !retrying.try_again(manifest.error(), stop)) return manifest;
  }
}

}  // namespace selvage
