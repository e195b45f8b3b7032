// SPDX-License-Identifier: MIT
//
// The library's front door: a model somewhere, and fetches of its regions that run in the background while
// regions are decoded and stitched.
//
//     auto model = selvage::Model::open("example.org:7878/bunny");
//     selvage::FetchEvents events;
//     events.on_update = [](const selvage::StitchUpdate& changes) { renderer.apply(changes); };
//     auto fetch = model->fetch({.kind = selvage::Selection::Kind::Ids, .ids = {3, 5}}, events);
//     fetch.reprioritise(0);  // they came into view
//     auto fetched = fetch.wait();
//
// Connections that break are made again, and what has arrived is not fetched twice. Errors say what the
// source is. A Model may be used by one thread at a time, and has one fetch at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "client/cache/part_cache.h"
#include "client/fetch/backoff.h"
#include "client/fetch/fetch_events.h"
#include "client/fetch/live_model.h"
#include "client/session/client_options.h"
#include "client/stitch/stitcher.h"
#include "common/pack/directory.h"
#include "common/pack/selection.h"

namespace selvage {

struct ModelOptions {
  ClientOptions connection;
  RetryPolicy retry;
  bool retry_open = false;  ///< try again too when the very first connection fails, as the policy says
  /// Where parts are kept between runs, for sources that are not files; see part_cache.h. Absent: nowhere.
  std::optional<std::filesystem::path> cache_folder = std::nullopt;
  std::uint64_t cache_bytes = kDefaultCacheBytes;
  unsigned decode_threads = 0;  ///< 0: all cores
};

struct FetchedModel {
  StitchedMesh mesh;
  std::uint32_t regions = 0;                  ///< that were selected and are in `mesh`
  std::uint32_t parts = 0, cached_parts = 0;  ///< that came over the wire, and that the cache had
  std::uint64_t bytes = 0, cached_bytes = 0;  ///< of those
  std::uint32_t retries = 0;
  /// From the start of the fetch until ...
  std::chrono::duration<double> time_to_first_region{};  ///< ... a first region was decoded
  std::chrono::duration<double> time_to_mesh{};          ///< ... everything was decoded and stitched
};

/// A fetch under way. Thread-safe but for wait() and moving.
class Fetch {
 public:
  ~Fetch();  ///< cancels, and returns when no callback runs any more
  Fetch(Fetch&&) noexcept;
  Fetch& operator=(Fetch&&) noexcept;

  void cancel();
  /// Among the requests of all clients: 0 first, 7 last. A web server knows no urgency.
  void reprioritise(std::uint8_t urgency);
  /// Returns when everything is stitched, or with the error that ended the fetch; Cancelled after cancel().
  Result<FetchedModel> wait();

 private:
  friend class Model;
  class Work;
  explicit Fetch(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

class Model {
 public:
  /// `source` is HOST:PORT/MODEL for a selvage server, http://... or https://... for a pack on a web server,
  /// or a pack's path. Returns once the model's directory is there. Errors name the source.
  static Result<Model> open(const std::string& source, ModelOptions options = {}, std::stop_token stop = {});
  /// The same without touching the network: the first fetch opens the model, in the same round trip where the
  /// source can, unless its selection is by name. For whoever knows what he wants before he has seen it.
  static Result<Model> at(const std::string& source, ModelOptions options = {});
  ~Model();
  Model(Model&&) noexcept;
  Model& operator=(Model&&) noexcept;

  /// Regions with their boxes, sizes and neighbours, names of parts, the grid. Of a model from at(), once a
  /// fetch has succeeded: then it has at least the regions fetched (Directory::has); the next fetch completes
  /// it.
  const Directory& directory() const;
  std::uint64_t directory_bytes() const;  ///< of it that came
  /// The selection's names are looked up here. `urgency` as in Fetch::reprioritise. The fetch must go before
  /// the model does.
  Fetch fetch(Selection selection, FetchEvents events = {}, std::uint8_t urgency = 3);

  /// For viewers whose regions come and go: shows nothing yet. It must go before the model does, and counts
  /// as the model's fetch.
  LiveModel live();

 private:
  friend class Fetch;
  struct State;
  explicit Model(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace selvage
