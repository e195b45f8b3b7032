// SPDX-License-Identifier: MIT
//
// One get that survives: takes what the cache has, asks the source for the rest, and asks again for what is
// still missing when a connection breaks.
#pragma once

#include <stop_token>

#include "client/cache/part_cache.h"
#include "client/fetch/missing_parts.h"
#include "client/fetch/retrying.h"
#include "client/session/part_source.h"

namespace selvage {

struct FetchPartsOptions {
  PartCache* cache = nullptr;  ///< borrowed; null: none
  RetryPolicy retry;
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

/// The same for open().
Result<std::shared_ptr<const Manifest>> open_with_retries(PartSource& source,
                                                          const FetchPartsOptions& options,
                                                          std::stop_token stop = {});

}  // namespace selvage
