// SPDX-License-Identifier: MIT
#include "client/fetch/model.h"

#include <mutex>
#include <thread>

#include "client/fetch/fetch_parts.h"
#include "client/fetch/missing_parts.h"
#include "client/fetch/open_source.h"
#include "client/stitch/part_collector.h"
#include "common/base/task_group.h"

namespace selvage {

using Clock = std::chrono::steady_clock;

// ---- decoding
// ------------------------------------------------------------------------------------------------

namespace {

/// Decodes and stitches on worker threads, tells the caller's events, and keeps the first failure.
class Decoding {
 public:
  Decoding(const Directory& directory, const FetchEvents& events, FetchProgress expected, unsigned threads)
      : directory_(directory),
        events_(events),
        begin_(Clock::now()),
        collector_(directory),
        progress_(expected),
        tasks_(threads) {}

  /// `part` lives until it is decoded: its receipt is what lets the sender send more.
  void add(ReceivedPart part) {
    {
      const std::scoped_lock lock(mutex_);
      ++progress_.parts;
      progress_.bytes += part.bytes.size();
    }
    tell_progress();
    const auto held = std::make_shared<ReceivedPart>(std::move(part));
    tasks_.run([this, held] { note(held->id, collector_.add(held->id, held->bytes)); });
  }

  void tell_retry(const Error& error, std::chrono::milliseconds delay) {
    const std::scoped_lock lock(telling_);
    if (events_.on_retry) events_.on_retry(error, delay);
  }

  Result<void> failure() {
    const std::scoped_lock lock(mutex_);
    if (failure_) return tl::unexpected(*failure_);
    return {};
  }

  /// Returns once nothing runs any more; `model` is filled in unless a part could not be decoded.
  Result<void> finish(FetchedModel& model) {
    tasks_.wait();
    if (auto ok = failure(); !ok) return ok;
    model.mesh = collector_.mesh();
    model.regions = progress_.regions;
    model.time_to_first_region = first_region_.value_or(begin_) - begin_;
    model.time_to_mesh = Clock::now() - begin_;
    const std::scoped_lock lock(telling_);
    if (events_.on_progress) events_.on_progress(progress_);
    if (events_.on_update) events_.on_update(model.mesh);
    return {};
  }

  void wait() { tasks_.wait(); }

 private:
  void note(const PartId& id, Result<void> outcome) {
    const auto now = Clock::now();
    const bool is_region = id.kind == PartKind::Region;
    {
      const std::scoped_lock lock(mutex_);
      if (!outcome && !failure_) failure_ = std::move(outcome.error());
      if (failure_) return;
      if (is_region && !first_region_) first_region_ = now;
      if (is_region && id.region != kLooseRegion) ++progress_.regions;
    }
    if (is_region) tell_region(id);
    tell_update(now);
  }

  void tell_progress() {
    if (!events_.on_progress) return;
    const std::scoped_lock lock(telling_);
    FetchProgress progress;
    {
      const std::scoped_lock inner(mutex_);
      progress = progress_;
    }
    events_.on_progress(progress);
  }

  void tell_region(const PartId& id) {
    if (!events_.on_region) return;
    const LevelEntry& entry = directory_.regions[id.region].levels[id.level];
    const std::scoped_lock lock(telling_);
    events_.on_region({id.region, id.level, entry.vertices, entry.triangles});
  }

  /// Whoever comes while another tells just goes on: the next update will have it.
  void tell_update(Clock::time_point now) {
    if (!events_.on_update) return;
    const std::unique_lock lock(telling_, std::try_to_lock);
    if (!lock || (last_update_ && now - *last_update_ < events_.update_interval)) return;
    events_.on_update(collector_.mesh());
    last_update_ = Clock::now();
  }

  const Directory& directory_;
  const FetchEvents& events_;
  const Clock::time_point begin_;
  PartCollector collector_;

  std::mutex mutex_;  ///< of what follows
  FetchProgress progress_;
  std::optional<Error> failure_;
  std::optional<Clock::time_point> first_region_;

  std::mutex telling_;  ///< held while an event runs; taken before mutex_
  std::optional<Clock::time_point> last_update_;

  TaskGroup tasks_;  // last: its tasks use the rest
};

Result<FetchProgress> expectation(const Directory& directory, const Selection& selection) {
  auto missing = MissingParts::of(directory, selection);
  if (!missing) return forward_error(missing);
  FetchProgress expected;
  for (const PartId& id : missing->ids()) {
    ++expected.of_parts;
    expected.of_bytes += directory.find(id)->size;
    if (id.kind == PartKind::Region && id.region != kLooseRegion) ++expected.of_regions;
  }
  return expected;
}

}  // namespace

// ---- model
// ---------------------------------------------------------------------------------------------------

struct Model::State {
  std::string name;  ///< of the source, for errors
  ModelOptions options;
  std::unique_ptr<PartSource> source;
  std::optional<PartCache> cache;
  std::shared_ptr<const Manifest> manifest;
};

class Fetch::Work {
 public:
  Work(Model::State& model, Selection selection, FetchEvents events, std::uint8_t urgency)
      : model_(model),
        events_(std::move(events)),
        dial_(std::make_shared<UrgencyDial>(urgency)),
        thread_([this, selection = std::move(selection)](const std::stop_token& stop) {
          outcome_ = run(selection, stop);
          if (!outcome_) outcome_->error().message = model_.name + ": " + outcome_->error().message;
        }) {}

  void cancel() { thread_.request_stop(); }
  void reprioritise(std::uint8_t urgency) { dial_->turn(urgency); }

  Result<FetchedModel> wait() {
    if (thread_.joinable()) thread_.join();
    return std::move(*outcome_);
  }

 private:
  Result<FetchedModel> run(const Selection& named, const std::stop_token& stop) {
    const Directory& directory = model_.manifest->directory;
    auto selection = resolve_names(directory, named);
    if (!selection) return forward_error(selection);
    auto expected = expectation(directory, *selection);
    if (!expected) return forward_error(expected);

    Decoding decoding(directory, events_, *expected, model_.options.decode_threads);
    FetchPartsOptions options;
    options.cache = model_.cache ? &*model_.cache : nullptr;
    options.retry = model_.options.retry;
    options.on_retry = [&](const Error& error, auto delay) { decoding.tell_retry(error, delay); };
    GetRequest request{model_.manifest, std::move(*selection)};
    request.dial = dial_;
    const auto on_part = [&](ReceivedPart part) {
      decoding.add(std::move(part));
      return decoding.failure();
    };
    auto stats = fetch_parts(*model_.source, std::move(request), on_part, options, stop);
    if (!stats) return forward_error(stats);

    FetchedModel model;
    if (auto ok = decoding.finish(model); !ok) return forward_error(ok);
    model.parts = stats->parts;
    model.cached_parts = stats->cached_parts;
    model.bytes = stats->bytes;
    model.cached_bytes = stats->cached_bytes;
    model.retries = stats->retries;
    return model;
  }

  Model::State& model_;
  const FetchEvents events_;
  const std::shared_ptr<UrgencyDial> dial_;
  std::optional<Result<FetchedModel>> outcome_;
  std::jthread thread_;  // last: it uses the rest
};

Result<Model> Model::open(const std::string& source, ModelOptions options, std::stop_token stop) {
  auto state = std::make_unique<State>();
  state->name = source;
  auto parts = open_source(source, options.connection);
  if (!parts) return forward_error(parts);
  state->source = std::move(parts->source);
  if (options.cache_folder && parts->is_remote) {
    auto cache = PartCache::open(*options.cache_folder, options.cache_bytes);
    if (!cache) return forward_error(cache);
    state->cache.emplace(std::move(*cache));
  }
  FetchPartsOptions retrying;
  if (options.retry_open) {
    retrying.retry = options.retry;
  } else {
    retrying.retry.give_up_after = std::chrono::milliseconds(0);
  }
  auto manifest = open_with_retries(*state->source, retrying, stop);
  if (!manifest) return forward_error(manifest, parts->is_remote ? std::string_view(source) : "");
  state->manifest = std::move(*manifest);
  state->options = std::move(options);
  return Model(std::move(state));
}

Model::Model(std::unique_ptr<State> state) : state_(std::move(state)) {}
Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

const Directory& Model::directory() const { return state_->manifest->directory; }
std::uint64_t Model::directory_bytes() const { return state_->manifest->directory_bytes; }

Fetch Model::fetch(Selection selection, FetchEvents events, std::uint8_t urgency) {
  return Fetch(std::make_unique<Fetch::Work>(*state_, std::move(selection), std::move(events), urgency));
}

Fetch::Fetch(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Fetch::~Fetch() = default;
Fetch::Fetch(Fetch&&) noexcept = default;
Fetch& Fetch::operator=(Fetch&&) noexcept = default;

void Fetch::cancel() { work_->cancel(); }
void Fetch::reprioritise(std::uint8_t urgency) { work_->reprioritise(urgency); }
Result<FetchedModel> Fetch::wait() { return work_->wait(); }

}  // namespace selvage
