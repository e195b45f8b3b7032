// SPDX-License-Identifier: MIT
#include "client/fetch/showing.h"

#include <utility>

namespace selvage {

Showing::Showing(const Directory& directory, PartCollector& collector, const FetchEvents& events,
                 unsigned threads)
    : directory_(directory),
      collector_(collector),
      events_(events),
      decoding_(collector, threads, [this](const PartId& id) { note_decoded(id); }) {}

void Showing::expect(const MissingParts& missing) {
  const std::scoped_lock lock(mutex_);
  for (const PartId& id : missing.ids()) {
    ++progress_.of_parts;
    progress_.of_bytes += directory_.find(id)->size;
    if (id.kind == PartKind::Region && id.region != kLooseRegion) ++progress_.of_regions;
  }
}

Result<void> Showing::add(ReceivedPart part) {
  {
    const std::scoped_lock lock(mutex_);
    ++progress_.parts;
    progress_.bytes += part.bytes.size();
  }
  tell_progress();
  return decoding_.add(std::move(part));
}

Result<void> Showing::finish(bool is_needed) {
  if (!is_needed) decoding_.drop_the_rest();
  auto decoded = decoding_.finish();
  tell_progress();
  if (events_.on_update) {
    const StitchUpdate update = collector_.take_update();
    if (!update.empty()) events_.on_update(update);
  }
  return decoded;
}

void Showing::tell_retry(const Error& error, std::chrono::milliseconds delay) {
  const std::scoped_lock lock(telling_);
  if (events_.on_retry) events_.on_retry(error, delay);
}

/// On whatever thread has decoded the part.
void Showing::note_decoded(const PartId& id) {
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
  if (id.kind == PartKind::Region && id.region != kLooseRegion) tell_region(id);
  tell_update(now);
}

void Showing::tell_progress() {
  if (!events_.on_progress) return;
  const std::scoped_lock lock(telling_);
  FetchProgress progress;
  {
    const std::scoped_lock inner(mutex_);
    progress = progress_;
  }
  events_.on_progress(progress);
}

void Showing::tell_region(const PartId& id) {
  if (!events_.on_region) return;
  const LevelEntry& entry = directory_.regions[id.region].levels[id.level];
  const std::scoped_lock lock(telling_);
  events_.on_region({id.region, id.level, entry.vertices, entry.triangles});
}

/// Whoever comes while another tells just goes on: the next update will have it.
void Showing::tell_update(Clock::time_point now) {
  if (!events_.on_update) return;
  const std::unique_lock lock(telling_, std::try_to_lock);
  if (!lock || (last_update_ && now - *last_update_ < events_.update_interval)) return;
  const StitchUpdate update = collector_.take_update();
  if (!update.empty()) events_.on_update(update);
  last_update_ = Clock::now();
}

}  // namespace selvage
