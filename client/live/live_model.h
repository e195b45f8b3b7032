// SPDX-License-Identifier: MIT
//
// A model while it is looked at: regions come, are refined, coarsened or dropped in place, and every step is
// a watertight mesh that reaches a renderer as an update.
//
//     LiveModel live(manifest, [&](auto request, const auto& on_part) { return client.get(request, on_part);
//     }); live.show({.level = 1}, draw);                                              // all of it, coarse
//     live.show({.kind = Selection::Kind::Ids, .ids = {3}}, draw);                // region 3 fine, in its
//     place
//
// A second show() fetches only what the first did not: parts at other levels, never a join again.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <span>

#include "client/session/blocking_client.h"
#include "client/stitch/part_collector.h"

namespace selvage {

/// One thread at a time; decoding runs on threads of its own.
class LiveModel {
 public:
  /// Where parts come from: BlockingClient::get, or anything that answers alike.
  using GetParts = std::function<Result<GetStats>(GetRequest, const BlockingClient::OnPart&)>;
  /// Called on the thread that called show() or hide(), never with an empty update.
  using OnUpdate = std::function<void(const StitchUpdate&)>;

  /// `threads` decode; 0: as many as the machine has.
  LiveModel(std::shared_ptr<const Manifest> manifest, GetParts get, unsigned threads = 0);

  /// Brings the selected regions to the levels that the selection says, whatever they are at, and leaves the
  /// others as they are. Returns when all are there, with what had to be fetched. After an error or a
  /// cancelled get each region is at its old or its new level, and the mesh is as sound as before; the same
  /// call again fetches the rest. The selection's `joins` does not count: joins come as they are needed.
  Result<GetStats> show(const Selection& selection, const OnUpdate& on_update);

  /// Takes regions away; those that are not there are no error.
  void hide(std::span<const RegionId> regions, const OnUpdate& on_update);

  /// Nothing if the region is not there.
  std::optional<std::uint8_t> level_of(RegionId region) const { return collector_.level_of(region); }
  StitchedMesh mesh() const { return collector_.mesh(); }
  const Directory& directory() const { return manifest_->directory; }

 private:
  bool is_shown(const PartId& id) const;
  Result<std::optional<GetRequest>> request_for(const Selection& selection) const;
  void flush(const OnUpdate& on_update);

  std::shared_ptr<const Manifest> manifest_;
  GetParts get_;
  unsigned threads_;
  PartCollector collector_;
  std::set<RegionId> bundles_;  ///< whose bundle is in the collector
};

}  // namespace selvage
