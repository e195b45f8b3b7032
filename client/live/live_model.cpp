// SPDX-License-Identifier: MIT
#include "client/live/live_model.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "common/base/task_group.h"
#include "common/pack/selection.h"

namespace selvage {
namespace {

/// Decodes parts beside the thread that receives them. Keeps the first failure and what went well.
class Decoding {
 public:
  Decoding(PartCollector& collector, unsigned threads) : collector_(collector), tasks_(threads) {}

  void add(ReceivedPart part) {
    auto held = std::make_shared<ReceivedPart>(std::move(part));
    tasks_.run([this, held] { note(held->id, collector_.add(held->id, held->bytes)); });
  }

  Result<void> failure() const {
    const std::scoped_lock lock(mutex_);
    if (failure_) return tl::unexpected(*failure_);
    return {};
  }

  /// Waits for all; the regions whose bundles were added.
  std::vector<RegionId> finish() {
    tasks_.wait();
    return bundles_;
  }

 private:
  void note(const PartId& id, Result<void> outcome) {
    const std::scoped_lock lock(mutex_);
    if (!outcome) {
      if (!failure_) failure_ = std::move(outcome.error());
    } else if (id.kind == PartKind::Bundle) {
      bundles_.push_back(id.region);
    }
  }

  PartCollector& collector_;
  mutable std::mutex mutex_;
  std::optional<Error> failure_;
  std::vector<RegionId> bundles_;
  TaskGroup tasks_;  // last: its tasks use the rest
};

}  // namespace

LiveModel::LiveModel(std::shared_ptr<const Manifest> manifest, GetParts get, unsigned threads)
    : manifest_(std::move(manifest)),
      get_(std::move(get)),
      threads_(threads),
      collector_(manifest_->directory) {}

Result<GetStats> LiveModel::show(const Selection& selection, const OnUpdate& on_update) {
  auto request = request_for(selection);
  if (!request) return forward_error(request);
  if (!*request) return GetStats{};
  Decoding decoding(collector_, threads_);
  auto stats = get_(std::move(**request), [&](ReceivedPart part) -> Result<void> {
    decoding.add(std::move(part));
    flush(on_update);
    return decoding.failure();
  });
  for (const RegionId region : decoding.finish()) bundles_.insert(region);
  flush(on_update);
  if (auto ok = decoding.failure(); !ok) return forward_error(ok);
  return stats;
}

void LiveModel::hide(std::span<const RegionId> regions, const OnUpdate& on_update) {
  for (const RegionId region : regions) collector_.remove_region(region);
  flush(on_update);
}

bool LiveModel::is_shown(const PartId& id) const {
  if (id.kind == PartKind::Bundle) return bundles_.contains(id.region);
  return collector_.level_of(id.region) == id.level;
}

/// Nothing if all is there. Else asks for the regions that are not, with every bundle that touches them, as
/// the neighbours that are shown already are no part of the selection.
Result<std::optional<GetRequest>> LiveModel::request_for(const Selection& selection) const {
  const Directory& directory = manifest_->directory;
  auto wanted = resolve_names(directory, selection);
  if (!wanted) return forward_error(wanted);
  wanted->joins = Joins::All;
  auto parts = select_parts(directory, *wanted);
  if (!parts) return forward_error(parts);

  std::vector<RegionId> missing, selected;
  bool lacks_shared = false;
  for (const PartId& id : *parts) {
    const bool is_lacking = !is_shown(id);
    if (id.kind == PartKind::Bundle || id.region == kLooseRegion) {
      lacks_shared = lacks_shared || is_lacking;
    } else {
      selected.push_back(id.region);
      if (is_lacking) missing.push_back(id.region);
    }
  }
  if (missing.empty() && !lacks_shared) return std::nullopt;

  GetRequest request;
  request.manifest = manifest_;
  request.selection = *wanted;
  request.selection.kind = Selection::Kind::Ids;
  request.selection.ids = lacks_shared ? std::move(selected) : std::move(missing);
  auto answer = select_parts(directory, request.selection);
  if (!answer) return forward_error(answer);
  // Two parts of equal bytes have one hash: what is held under it does not help the other.
  std::set<Hash> lacking;
  for (const PartId& id : *answer) {
    if (!is_shown(id)) lacking.insert(directory.find(id)->hash);
  }
  for (const PartId& id : *answer) {
    const Hash& hash = directory.find(id)->hash;
    if (is_shown(id) && !lacking.contains(hash)) request.have.push_back(hash);
  }
  return request;
}

void LiveModel::flush(const OnUpdate& on_update) {
  const StitchUpdate update = collector_.take_update();
  const bool is_empty = update.vertices.empty() && update.patches.empty() && update.removed_vertices.empty();
  if (!is_empty) on_update(update);
}

}  // namespace selvage
