// SPDX-License-Identifier: MIT
#include "client/fetch/model.h"

#include <thread>

#include "client/fetch/fetch_parts.h"
#include "client/fetch/open_source.h"

namespace selvage {

using Clock = std::chrono::steady_clock;

struct Model::State {
  std::string name;  ///< of the source, for errors
  ModelOptions options;
  std::unique_ptr<PartSource> source;
  std::optional<PartCache> cache;
  std::shared_ptr<const Manifest> manifest;

  LiveModel live() {
    ShowOptions show;
    show.fetch.cache = cache ? &*cache : nullptr;
    show.fetch.retry = options.retry;
    show.threads = options.decode_threads;
    return LiveModel(manifest, *source, std::move(show));
  }
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
  Result<FetchedModel> run(const Selection& selection, const std::stop_token& stop) {
    const auto begin = Clock::now();
    LiveModel live = model_.live();
    auto shown = live.show(selection, events_, stop, dial_);
    if (!shown) return forward_error(shown);
    FetchedModel model;
    model.mesh = live.mesh();
    model.regions = shown->regions;
    model.parts = shown->fetched.parts;
    model.cached_parts = shown->fetched.cached_parts;
    model.bytes = shown->fetched.bytes;
    model.cached_bytes = shown->fetched.cached_bytes;
    model.retries = shown->fetched.retries;
    model.time_to_first_region = shown->first_region.value_or(begin) - begin;
    model.time_to_mesh = Clock::now() - begin;
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

LiveModel Model::live() { return state_->live(); }

Fetch::Fetch(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Fetch::~Fetch() = default;
Fetch::Fetch(Fetch&&) noexcept = default;
Fetch& Fetch::operator=(Fetch&&) noexcept = default;

void Fetch::cancel() { work_->cancel(); }
void Fetch::reprioritise(std::uint8_t urgency) { work_->reprioritise(urgency); }
Result<FetchedModel> Fetch::wait() { return work_->wait(); }

}  // namespace selvage
