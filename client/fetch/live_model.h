// SPDX-License-Identifier: MIT
//
// A model while it is looked at: regions come, are refined, coarsened or dropped in place, and every step is
// a watertight mesh that reaches a renderer as an update.
//
//     LiveModel live(manifest, source);
//     FetchEvents events;
//     events.on_update = [&](const StitchUpdate& update) { renderer.apply(update); };
//     live.show({.level = 1}, events);                                     // all of it, coarse
//     live.show({.kind = Selection::Kind::Ids, .ids = {3}}, events);       // region 3 fine, in its place
//
// A second show() fetches only what the first did not: parts at other levels, never a join again.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <vector>

#include "client/fetch/fetch_events.h"
#include "client/fetch/fetch_parts.h"
#include "client/fetch/missing_parts.h"
#include "client/session/part_source.h"
#include "client/stitch/part_collector.h"

namespace selvage {

class Showing;

/// How show() gets at parts.
struct ShowOptions {
  FetchPartsOptions fetch;  ///< its on_retry is not used: see FetchEvents
  unsigned threads = 0;     ///< that decode; 0: as many as the machine has
};

/// What a show() brought.
struct Shown {
  FetchPartsStats fetched;
  std::uint32_t regions = 0;                                          ///< decoded
  std::optional<std::chrono::steady_clock::time_point> first_region;  ///< when the first of them was
};

/// One thread at a time; decoding runs on threads of its own.
class LiveModel {
 public:
  /// `source`, and the cache of the options, are borrowed.
  LiveModel(std::shared_ptr<Manifest> manifest, PartSource& source, ShowOptions options = {});
  /// Of a model that the first show() opens, in the same round trip where the source can.
  explicit LiveModel(PartSource& source, ShowOptions options = {});

  /// Brings the selected regions to the levels that the selection says, whatever they are at, and leaves the
  /// others as they are. Returns when all are there. After an error, and after `stop`, each region is at its
  /// old or its new level, and the mesh is as sound as before; the same call again fetches the rest.
  /// The selection's joins are those of a get while nothing else is shown; later, closure means all that join
  /// the selected regions to each other and to what is shown. `dial` is the urgency while it runs.
  Result<Shown> show(const Selection& selection, const FetchEvents& events = {}, std::stop_token stop = {},
                     std::shared_ptr<UrgencyDial> dial = {});

  /// Takes regions away; those that are not there are no error. `on_update` is called once, or not at all if
  /// nothing has changed.
  void hide(std::span<const RegionId> regions, const std::function<void(const StitchUpdate&)>& on_update);

  /// Nothing if the region is not there.
  std::optional<std::uint8_t> level_of(RegionId region) const;
  /// Built anew: linear in what is shown.
  StitchedMesh mesh() const;
  /// Null until the model was opened. The directory has what the regions shown need, and more if it came; it
  /// does not change but in show().
  const std::shared_ptr<Manifest>& manifest() const { return manifest_; }
  const Directory& directory() const { return manifest_->directory; }  ///< once there is a manifest

 private:
  /// A fetch that tells `showing`, which it makes once there is a directory.
  using OnShowing = std::function<Showing&()>;

  void hold(std::shared_ptr<Manifest> manifest);
  Result<FetchPartsStats> fetch_first(FirstRequest request, const OnShowing& begin,
                                      const FetchPartsOptions& options, std::stop_token stop);
  Result<FetchPartsStats> fetch_more(FirstRequest request, const OnShowing& begin,
                                     const FetchPartsOptions& options, std::stop_token stop);
  bool is_shown(const PartId& id) const;
  Result<Selection> to_fetch(const Selection& selection) const;
  Result<MissingParts> missing_of(const Selection& selection) const;

  PartSource& source_;
  const ShowOptions options_;
  std::shared_ptr<Manifest> manifest_;
  std::unique_ptr<PartCollector> collector_;  ///< once there is a manifest
  std::set<RegionId> bundles_;                ///< whose bundle is in the collector
};

}  // namespace selvage
