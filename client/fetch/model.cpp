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
  std::shared_ptr<Manifest> manifest;  ///< null until the model was opened

  FetchPartsOptions fetch_options() {
    FetchPartsOptions fetch;
    fetch.cache = cache ? &*cache : nullptr;
    fetch.retry = options.retry;
    fetch.retry_open = options.retry_open;
    return fetch;
  }
  LiveModel live() {
    const ShowOptions show{fetch_options(), options.decode_threads};
    return manifest ? LiveModel(manifest, *source, show) : LiveModel(*source, show);
  }
  /// Errors of files name them already.
  Error named(Error error) const {
    if (!error.message.starts_with(name)) error.message = name + ": " + error.message;
    return error;
  }
  /// Parts that are cached can only be left out of a request by who has the directory.
  bool is_worth_opening_first() const { return !manifest && cache && cache->has_visited(name); }
  Result<void> open(std::stop_token stop) {
    auto opened = open_with_retries(*source, fetch_options(), std::move(stop));
    if (!opened) return forward_error(opened);
    manifest = std::make_shared<Manifest>(**opened);
    return {};
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
          if (!*outcome_) outcome_ = tl::unexpected(model_.named(std::move(outcome_->error())));
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
    if (model_.is_worth_opening_first()) {
      if (auto ok = model_.open(stop); !ok) return forward_error(ok);
    }
    // Before anything comes: what an interrupted fetch leaves in the cache is of use to the next.
    if (model_.cache) model_.cache->note_visit(model_.name);
    LiveModel live = model_.live();
    auto shown = live.show(selection, events_, stop, dial_);
    if (!shown) return forward_error(shown);
    model_.manifest = live.manifest();
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

Result<Model> Model::at(const std::string& source, ModelOptions options) {
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
  state->options = std::move(options);
  return Model(std::move(state));
}

Result<Model> Model::open(const std::string& source, ModelOptions options, std::stop_token stop) {
  auto model = at(source, std::move(options));
  if (!model) return model;
  auto opened = model->state_->open(std::move(stop));
  if (!opened) return tl::unexpected(model->state_->named(std::move(opened.error())));
  return model;
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
