// SPDX-License-Identifier: MIT
//
// One get that survives: takes what the cache has, asks the source for the rest, and asks again for what is
// still missing when a connection breaks.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "client/cache/part_cache.h"
#include "client/fetch/missing_parts.h"
#include "client/fetch/retrying.h"
#include "client/session/part_source.h"

namespace selvage {

struct FetchPartsOptions {
  PartCache* cache = nullptr;  ///< borrowed; null: none
  RetryPolicy retry;
  bool retry_open = true;  ///< false: what fails before anything has come is the last word
  Retrying::OnRetry on_retry = {};
};

struct FetchPartsStats {
  std::uint32_t parts = 0;  ///< fetched
  std::uint64_t bytes = 0;  ///< of them
  std::uint32_t cached_parts = 0;
  std::uint64_t cached_bytes = 0;
  std::uint32_t retries = 0;
};

/// Every part that is missing reaches `on_part` once, on the calling thread. `missing` belongs to the
/// request's selection; the request's `have` is not used. Ends with the first error that will not pass, with
/// that of `on_part`, or with the last of those that might have passed once the policy gives up. Cancelled
/// soon after `stop`.
Result<FetchPartsStats> fetch_parts(PartSource& source, GetRequest request, MissingParts missing,
                                    const PartSource::OnPart& on_part, const FetchPartsOptions& options,
                                    std::stop_token stop = {});
/// The same with nothing there yet.
Result<FetchPartsStats> fetch_parts(PartSource& source, GetRequest request, const PartSource::OnPart& on_part,
                                    const FetchPartsOptions& options, std::stop_token stop = {});

/// Also opens the model, in one round trip where the source can: for a first look at one of which the cache
/// knows nothing. Every part of the request's selection reaches `on_part` once. `on_manifest` is called once,
/// before that, with a manifest that grows: pages are read into its directory between two calls of `on_part`,
/// the ones that list a part before it; some may be missing in the end. A first failure to connect ends it,
/// unless `retry_open`.
using OnGrowingManifest = std::function<Result<void>(std::shared_ptr<Manifest>)>;
Result<FetchPartsStats> open_and_fetch_parts(PartSource& source, FirstRequest request,
                                             const OnGrowingManifest& on_manifest,
                                             const PartSource::OnPart& on_part,
                                             const FetchPartsOptions& options, std::stop_token stop = {});

/// Fills in what the directory of a manifest lacks. ModelChanged if the source has another pack by now.
Result<void> complete(Manifest& manifest, PartSource& source, const FetchPartsOptions& options,
                      std::stop_token stop = {});

/// The same for open().
Result<std::shared_ptr<const Manifest>> open_with_retries(PartSource& source,
                                                          const FetchPartsOptions& options,
                                                          std::stop_token stop = {});

}  // namespace selvage
