// SPDX-License-Identifier: MIT
#include "server/session/request_handler.h"

#include <algorithm>
#include <chrono>

#include "common/pack/selection.h"

namespace selvage {
namespace {

/// With names and reasons at their longest this stays far below a frame's 1 MiB.
constexpr std::size_t kModelsPerPage = 500;

ModelInfo describe(const PackStore::Model& model) {
  ModelInfo info;
  info.name = model.name;
  info.size_bytes = model.size_bytes;
  if (!model.pack) {
    info.problem = model.pack.error().to_string();
    return info;
  }
  const Pack& pack = **model.pack;
  info.pack_id = pack.id();
  info.regions = pack.directory().real_region_count();
  info.vertices = pack.directory().vertices;
  info.triangles = pack.directory().triangles;
  return info;
}

/// What the client holds of a part: nothing, its first bytes, or all.
class Held {
 public:
  explicit Held(const GetParts& request) : whole_(request.have), partial_(request.partial) {
    std::ranges::sort(whole_);
    std::ranges::sort(partial_, {}, &PartialPart::hash);
  }

  bool whole(const Hash& hash) const { return std::ranges::binary_search(whole_, hash); }

  /// An offset past the part's end is no help: it is then sent from the start.
  std::uint32_t bytes_of(const PartRef& ref) const {
    const auto found = std::ranges::lower_bound(partial_, ref.hash, {}, &PartialPart::hash);
    const bool helps = found != partial_.end() && found->hash == ref.hash && found->offset < ref.size;
    return helps ? found->offset : 0;
  }

 private:
  std::vector<Hash> whole_;
  std::vector<PartialPart> partial_;
};

}  // namespace

Models answer_list(const ListModels& request, const std::vector<PackStore::Model>& models) {
  Models page;
  auto next = std::ranges::upper_bound(models, request.after, {}, &PackStore::Model::name);
  for (; next != models.end() && page.models.size() < kModelsPerPage; ++next) {
    page.models.push_back(describe(*next));
  }
  page.more = next != models.end();
  return page;
}

Answer answer_open(std::uint32_t request_id, const OpenModel& request, std::shared_ptr<const Pack> pack) {
  const std::uint64_t whole = pack->directory_bytes().size();
  const std::uint32_t summary = pack->header().summary_size;
  const bool is_held = request.held == pack->id();
  Answer answer;
  answer.request_id = request_id;
  answer.manifest =
      ManifestBegin{pack->id(), summary, whole, is_held ? 0 : (request.summary_only ? summary : whole)};
  answer.pack = std::move(pack);
  return answer;
}

Result<Answer> answer_get(std::uint32_t request_id, const GetParts& request, std::shared_ptr<const Pack> pack,
                          const SessionLimits& limits) {
  if (request.pack_id && *request.pack_id != pack->id()) {
    return fail(ErrorCode::ModelChanged, "'" + request.model + "' is another pack now; open it again");
  }
  if (std::max(request.selection.ids.size(), request.selection.levels.size()) > limits.ids_per_request) {
    return fail(ErrorCode::LimitExceeded, "more than " + std::to_string(limits.ids_per_request) +
                                              " region ids or levels in one request");
  }
  auto selected = select_parts(pack->directory(), request.selection);
  if (!selected) return forward_error(selected);
  const auto parts = with_pages(pack->directory(), std::move(*selected), request.pages);

  Answer answer;
  answer.request_id = request_id;
  answer.urgency = request.urgency;
  answer.items.reserve(parts.size());
  const Held held(request);
  for (const PartId& id : parts) {
    const PartRef& ref = *pack->directory().find(id);
    if (held.whole(ref.hash)) {
      ++answer.held;
    } else {
      answer.items.push_back({id, held.bytes_of(ref), &ref});
    }
  }
  answer.pack = std::move(pack);
  return answer;
}

StatusReport answer_status(const SessionServices& services, bool is_draining) {
  const ServerCounters& counters = services.counters;
  StatusReport report;
  report.software = std::string("selvage-server ") + SELVAGE_VERSION;
  const auto uptime = std::chrono::system_clock::now() - counters.started;
  report.uptime_seconds =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(uptime).count());
  report.draining = is_draining;
  report.is_encrypted = services.is_encrypted;
  PackStore::Summary summary = services.store.summary();
  report.models = summary.models;
  report.model_bytes = summary.bytes;
  for (auto& [name, problem] : summary.refused) report.problems.push_back({name, std::move(problem)});
  report.connections = counters.sessions;
  report.max_connections = services.max_connections;
  report.connections_accepted = counters.connections;
  report.connections_refused = counters.connections_refused;
  report.requests = counters.lists + counters.opens + counters.gets + counters.statuses + counters.publishes +
                    counters.unpublishes;
  for (const auto& count : counters.errors) report.errors += count;
  report.bytes_sent = counters.bytes_sent;
  report.bytes_uploaded = counters.bytes_uploaded;
  report.published = counters.published;
  report.publish_failed = counters.publish_failed;
  if (services.publishing != nullptr) report.jobs = services.publishing->jobs();
  return report;
}

}  // namespace selvage
