// SPDX-License-Identifier: MIT
#include "client/fetch/live_model.h"

#include <algorithm>
#include <utility>

#include "client/fetch/showing.h"
#include "common/pack/selection.h"

namespace selvage {
LiveModel::LiveModel(std::shared_ptr<Manifest> manifest, PartSource& source, ShowOptions options)
    : LiveModel(source, std::move(options)) {
  hold(std::move(manifest));
}

LiveModel::LiveModel(PartSource& source, ShowOptions options)
    : source_(source), options_(std::move(options)) {}

void LiveModel::hold(std::shared_ptr<Manifest> manifest) {
  manifest_ = std::move(manifest);
  collector_ = std::make_unique<PartCollector>(manifest_->directory);
}

Result<Shown> LiveModel::show(const Selection& selection, const FetchEvents& events, std::stop_token stop,
                              std::shared_ptr<UrgencyDial> dial) {
  std::optional<Showing> showing;
  FetchPartsOptions options = options_.fetch;
  options.on_retry = [&](const Error& error, auto delay) {
    if (showing) return showing->tell_retry(error, delay);
    if (events.on_retry) events.on_retry(error, delay);
  };
  const auto begin = [&]() -> Showing& {
    return showing.emplace(directory(), *collector_, events, options_.threads);
  };
  FirstRequest request{selection};
  request.dial = std::move(dial);
  const bool has_names = !selection.names.empty() || !selection.name_levels.empty();
  auto fetched = manifest_ || has_names ? fetch_more(std::move(request), begin, options, stop)
                                        : fetch_first(std::move(request), begin, options, stop);
  if (!showing) return forward_error(fetched);
  auto decoded = showing->finish(fetched.has_value());
  bundles_.insert(showing->bundles().begin(), showing->bundles().end());
  if (!decoded) return forward_error(decoded);
  if (!fetched) return forward_error(fetched);
  return Shown{*fetched, showing->regions(), showing->first_region()};
}

/// Nothing is known of the model: what there is to show is known once the pages are there that list it.
Result<FetchPartsStats> LiveModel::fetch_first(FirstRequest request, const OnShowing& begin,
                                               const FetchPartsOptions& options, std::stop_token stop) {
  Showing* showing = nullptr;
  const Selection selection = request.selection;
  std::ptrdiff_t pages_seen = -1;  // none once everything is expected
  const auto expect = [&] {
    const auto pages = std::ranges::count_if(directory().pages, &PageEntry::is_read);
    if (pages == pages_seen) return;
    pages_seen = pages;
    if (pages_for(selection) == Pages::All && !directory().is_complete()) return;
    auto missing = MissingParts::of(directory(), selection);
    if (missing) showing->expect(*missing);
  };
  const auto on_manifest = [&](std::shared_ptr<Manifest> manifest) -> Result<void> {
    hold(std::move(manifest));
    showing = &begin();
    return {};
  };
  const auto on_part = [&](ReceivedPart part) {
    expect();
    return showing->add(std::move(part));
  };
  return open_and_fetch_parts(source_, std::move(request), on_manifest, on_part, options, std::move(stop));
}

Result<FetchPartsStats> LiveModel::fetch_more(FirstRequest request, const OnShowing& begin,
                                              const FetchPartsOptions& options, std::stop_token stop) {
  if (!manifest_) {
    auto opened = open_with_retries(source_, options, stop);
    if (!opened) return forward_error(opened);
    hold(std::make_shared<Manifest>(**opened));
  }
  if (auto ok = complete(*manifest_, source_, options, stop); !ok) return forward_error(ok);
  auto wanted = to_fetch(request.selection);
  if (!wanted) return forward_error(wanted);
  auto missing = missing_of(*wanted);
  if (!missing) return forward_error(missing);
  Showing& showing = begin();
  showing.expect(*missing);
  GetRequest get{manifest_, std::move(*wanted)};
  get.dial = std::move(request.dial);
  const auto on_part = [&](ReceivedPart part) { return showing.add(std::move(part)); };
  return fetch_parts(source_, std::move(get), std::move(*missing), on_part, options, std::move(stop));
}

void LiveModel::hide(std::span<const RegionId> regions,
                     const std::function<void(const StitchUpdate&)>& on_update) {
  if (!collector_) return;
  for (const RegionId region : regions) collector_->remove_region(region);
  const StitchUpdate update = collector_->take_update();
  if (!update.empty()) on_update(update);
}

std::optional<std::uint8_t> LiveModel::level_of(RegionId region) const {
  return collector_ ? collector_->level_of(region) : std::nullopt;
}

StitchedMesh LiveModel::mesh() const { return collector_ ? collector_->mesh() : StitchedMesh(); }

bool LiveModel::is_shown(const PartId& id) const {
  if (id.kind == PartKind::Bundle) return bundles_.contains(id.region);
  return collector_->level_of(id.region) == id.level;
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
  if (std::ranges::none_of(collector_->regions(), is_elsewhere)) return wanted;

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
