// SPDX-License-Identifier: MIT
#include "client/fetch/fetch_parts.h"

namespace selvage {
namespace {

std::uint64_t size_of(const UnfinishedParts& parts) {
  std::uint64_t bytes = 0;
  for (const auto& [hash, front] : parts) bytes += front.size();
  return bytes;
}

Result<void> take_cached(PartCache& cache, const Directory& directory, MissingParts& missing,
                         const PartSource::OnPart& on_part, FetchPartsStats& stats) {
  const std::vector<PartId> ids(missing.ids().begin(), missing.ids().end());
  for (const PartId& id : ids) {
    auto bytes = cache.find(*directory.find(id));
    if (!bytes) continue;
    missing.take(id);
    ++stats.cached_parts;
    stats.cached_bytes += bytes->size();
    auto taken = on_part({id, std::move(*bytes), {}});
    if (!taken) return forward_error(taken);
  }
  return {};
}

}  // namespace

Result<FetchPartsStats> fetch_parts(PartSource& source, GetRequest request, const PartSource::OnPart& on_part,
                                    const FetchPartsOptions& options, std::stop_token stop) {
  auto missing = MissingParts::of(request.manifest->directory, request.selection);
  if (!missing) return forward_error(missing);
  return fetch_parts(source, std::move(request), std::move(*missing), on_part, options, std::move(stop));
}

Result<FetchPartsStats> fetch_parts(PartSource& source, GetRequest request, MissingParts missing,
                                    const PartSource::OnPart& on_part, const FetchPartsOptions& options,
                                    std::stop_token stop) {
  const Directory& directory = request.manifest->directory;
  FetchPartsStats stats;
  if (options.cache != nullptr) {
    auto ok = take_cached(*options.cache, directory, missing, on_part, stats);
    if (!ok) return forward_error(ok);
  }

  bool is_refused = false;  // by on_part: no try will help
  const auto take = [&](ReceivedPart part) -> Result<void> {
    if (!missing.take(part.id)) return {};  // came twice, because a request can hold only so many hashes
    if (options.cache != nullptr) options.cache->put(directory.find(part.id)->hash, part.bytes);
    ++stats.parts;
    stats.bytes += part.bytes.size();
    auto taken = on_part(std::move(part));
    is_refused = !taken;
    return taken;
  };
  if (!request.unfinished) request.unfinished = std::make_shared<UnfinishedParts>();
  Retrying retrying(options.retry, options.on_retry);
  while (!missing.empty()) {
    request.have = missing.held();
    const std::uint64_t before = stats.bytes + size_of(*request.unfinished);
    const auto outcome = source.get(request, take, stop);
    if (outcome) break;
    if (stats.bytes + size_of(*request.unfinished) > before) retrying.note_progress();
    if (is_refused || !retrying.try_again(outcome.error(), stop)) return tl::unexpected(outcome.error());
    ++stats.retries;
  }
  if (!missing.empty()) {
    return fail(ErrorCode::BadStream,
                std::to_string(missing.ids().size()) + " parts of the answer did not come");
  }
  return stats;
}

Result<FetchPartsStats> open_and_fetch_parts(PartSource& source, FirstRequest request,
                                             const OnGrowingManifest& on_manifest,
                                             const PartSource::OnPart& on_part,
                                             const FetchPartsOptions& options, std::stop_token stop) {
  FetchPartsStats stats;
  std::shared_ptr<Manifest> manifest;
  std::set<PartId> taken;
  bool is_refused = false;  // by one of the callbacks: no try will help
  const auto open = [&](Manifest opened) -> Result<void> {
    manifest = std::make_shared<Manifest>(std::move(opened));
    auto ok = on_manifest(manifest);
    is_refused = !ok;
    return ok;
  };
  const auto take = [&](ReceivedPart part) -> Result<void> {
    if (options.cache != nullptr) options.cache->put(manifest->directory.find(part.id)->hash, part.bytes);
    if (part.id.kind == PartKind::Page) {
      manifest->directory_bytes += part.bytes.size();
      return read_page(manifest->directory, part.id.region, part.bytes);
    }
    taken.insert(part.id);
    ++stats.parts;
    stats.bytes += part.bytes.size();
    auto ok = on_part(std::move(part));
    is_refused = !ok;
    return ok;
  };
  request.unfinished = std::make_shared<UnfinishedParts>();
  Retrying retrying(options.retry, options.on_retry);
  while (!manifest) {
    auto outcome = source.open_and_get(request, open, take, stop);
    if (outcome) return stats;
    const bool is_last = is_refused || (!manifest && !options.retry_open);
    if (is_last || !retrying.try_again(outcome.error(), stop)) return forward_error(outcome);
    ++stats.retries;
  }

  // What came before the connection broke is there; the rest is fetched like that of any open model.
  if (auto ok = complete(*manifest, source, options, stop); !ok) return forward_error(ok);
  GetRequest rest{manifest, request.selection};
  rest.urgency = request.urgency;
  rest.dial = request.dial;
  rest.unfinished = request.unfinished;
  auto missing = MissingParts::of(manifest->directory, rest.selection);
  if (!missing) return forward_error(missing);
  for (const PartId& id : taken) missing->take(id);
  auto fetched = fetch_parts(source, std::move(rest), std::move(*missing), on_part, options, std::move(stop));
  if (!fetched) return fetched;
  fetched->parts += stats.parts;
  fetched->bytes += stats.bytes;
  fetched->retries += stats.retries;
  return fetched;
}

Result<void> complete(Manifest& manifest, PartSource& source, const FetchPartsOptions& options,
                      std::stop_token stop) {
  if (manifest.directory.is_complete()) return {};
  auto whole = open_with_retries(source, options, std::move(stop));
  if (!whole) return forward_error(whole);
  if ((*whole)->pack_id != manifest.pack_id) {
    return fail(ErrorCode::ModelChanged, "'" + manifest.name + "' is another pack now; open it again");
  }
  complete(manifest.directory, (*whole)->directory);
  manifest.directory_bytes += (*whole)->directory_bytes;
  return {};
}

Result<std::shared_ptr<const Manifest>> open_with_retries(PartSource& source,
                                                          const FetchPartsOptions& options,
                                                          std::stop_token stop) {
  Retrying retrying(options.retry, options.on_retry);
  for (;;) {
    auto manifest = source.open(stop);
    if (manifest || !options.retry_open || !retrying.try_again(manifest.error(), stop)) return manifest;
  }
}

}  // namespace selvage
