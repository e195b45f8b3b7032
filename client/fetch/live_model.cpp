// SPDX-License-Identifier: MIT
#include "client/fetch/live_model.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "client/fetch/decoding.h"
#include "common/pack/selection.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;

bool is_empty(const StitchUpdate& update) {
  return update.vertices.empty() && update.patches.empty() && update.removed_vertices.empty();
}

/// One show(): what it has brought so far, and who is told of it.
class Showing {
 public:
  Showing(const Directory& directory, PartCollector& collector, const MissingParts& missing,
          const FetchEvents& events)
      : directory_(directory), collector_(collector), events_(events) {
    for (const PartId& id : missing.ids()) {
      ++progress_.of_parts;
      progress_.of_bytes += directory.find(id)->size;
      if (id.kind == PartKind::Region && id.region != kLooseRegion) ++progress_.of_regions;
    }
  }

  void note_arrival(const ReceivedPart& part) {
    {
      const std::scoped_lock lock(mutex_);
      ++progress_.parts;
      progress_.bytes += part.bytes.size();
    }
    tell_progress();
  }

  /// On whatever thread has decoded the part.
  void note_decoded(const PartId& id) {
    const auto now = Clock::now();
    {
      const std::scoped_lock lock(mutex_);
      if (id.kind == PartKind::Bundle) {
        bundles_.push_back(id.region);
      } else {
        if (!first_region_) first_region_ = now;
        if (id.region != kLooseRegion) ++progress_.regions;
      }
    }
    if (id.kind == PartKind::Region) tell_region(id);
    tell_update(now);
  }

  void tell_retry(const Error& error, std::chrono::milliseconds delay) {
    const std::scoped_lock lock(telling_);
    if (events_.on_retry) events_.on_retry(error, delay);
  }

  /// When nothing is decoded any more.
  void tell_the_rest() {
    tell_progress();
    if (!events_.on_update) return;
    const StitchUpdate update = collector_.take_update();
    if (!is_empty(update)) events_.on_update(update);
  }

  const std::vector<RegionId>& bundles() const { return bundles_; }
  Shown shown(const FetchPartsStats& fetched) const { return {fetched, progress_.regions, first_region_}; }

 private:
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
    const StitchUpdate update = collector_.take_update();
    if (!is_empty(update)) events_.on_update(update);
    last_update_ = Clock::now();
  }

  const Directory& directory_;
  PartCollector& collector_;
  const FetchEvents& events_;

  std::mutex mutex_;  ///< of what follows
  FetchProgress progress_;
  std::vector<RegionId> bundles_;
  std::optional<Clock::time_point> first_region_;

  std::mutex telling_;  ///< held while an event runs; taken before mutex_
  std::optional<Clock::time_point> last_update_;
};

}  // namespace

LiveModel::LiveModel(std::shared_ptr<const Manifest> manifest, PartSource& source, ShowOptions options)
    : manifest_(std::move(manifest)),
      source_(source),
      options_(std::move(options)),
      collector_(manifest_->directory) {}

Result<Shown> LiveModel::show(const Selection& selection, const FetchEvents& events, std::stop_token stop,
                              std::shared_ptr<UrgencyDial> dial) {
  auto wanted = to_fetch(selection);
  if (!wanted) return forward_error(wanted);
  auto missing = missing_of(*wanted);
  if (!missing) return forward_error(missing);

  Showing showing(directory(), collector_, *missing, events);
  Decoding decoding(collector_, options_.threads, [&](const PartId& id) { showing.note_decoded(id); });
  FetchPartsOptions options = options_.fetch;
  options.on_retry = [&](const Error& error, auto delay) { showing.tell_retry(error, delay); };
  GetRequest request{manifest_, std::move(*wanted)};
  request.dial = std::move(dial);
  const auto on_part = [&](ReceivedPart part) {
    showing.note_arrival(part);
    return decoding.add(std::move(part));
  };
  auto fetched =
      fetch_parts(source_, std::move(request), std::move(*missing), on_part, options, std::move(stop));
  if (!fetched) decoding.drop_the_rest();
  auto decoded = decoding.finish();
  bundles_.insert(showing.bundles().begin(), showing.bundles().end());
  showing.tell_the_rest();
  if (!decoded) return forward_error(decoded);
  if (!fetched) return forward_error(fetched);
  return showing.shown(*fetched);
}

void LiveModel::hide(std::span<const RegionId> regions,
                     const std::function<void(const StitchUpdate&)>& on_update) {
  for (const RegionId region : regions) collector_.remove_region(region);
  const StitchUpdate update = collector_.take_update();
  if (!is_empty(update)) on_update(update);
}

bool LiveModel::is_shown(const PartId& id) const {
  if (id.kind == PartKind::Bundle) return bundles_.contains(id.region);
  return collector_.level_of(id.region) == id.level;
}

Result<MissingParts> LiveModel::missing_of(const Selection& selection) const {
  auto missing = MissingParts::of(directory(), selection);
  if (!missing) return missing;
  const std::vector<PartId> ids(missing->ids().begin(), missing->ids().end());
  for (const PartId& id : ids) {
    if (is_shown(id)) missing->take(id);
  }
  return missing;
}

/// The selection itself while nothing else is shown. Later, the regions that are not there yet, with every
/// bundle that touches them, as the neighbours that are shown are no part of the selection: then a request
/// says little of what is there already.
Result<Selection> LiveModel::to_fetch(const Selection& selection) const {
  auto wanted = resolve_names(directory(), selection);
  if (!wanted) return wanted;
  auto selected = select_regions(directory(), *wanted);
  if (!selected) return forward_error(selected);
  const auto is_elsewhere = [&](RegionId region) {
    return region != kLooseRegion && !std::ranges::binary_search(*selected, region);
  };
  if (std::ranges::none_of(collector_.regions(), is_elsewhere)) return wanted;

  if (wanted->joins == Joins::Closure) wanted->joins = Joins::All;
  auto parts = select_parts(directory(), *wanted);
  if (!parts) return forward_error(parts);
  std::vector<RegionId> missing;
  bool lacks_shared = false;
  for (const PartId& id : *parts) {
    if (is_shown(id)) continue;
    if (id.kind == PartKind::Bundle || id.region == kLooseRegion) {
      lacks_shared = true;
    } else {
      missing.push_back(id.region);
    }
  }
  wanted->kind = Selection::Kind::Ids;
  wanted->ids = lacks_shared ? std::move(*selected) : std::move(missing);
  return wanted;
}

}  // namespace selvage
