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
  request.unfinished = std::make_shared<UnfinishedParts>();
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

Result<std::shared_ptr<const Manifest>> open_with_retries(PartSource& source,
                                                          const FetchPartsOptions& options,
                                                          std::stop_token stop) {
  Retrying retrying(options.retry, options.on_retry);
  for (;;) {
    auto manifest = source.open(stop);
    if (manifest || !retrying.try_again(manifest.error(), stop)) return manifest;
  }
}

}  // namespace selvage
