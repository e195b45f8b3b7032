// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "client/session/part_source.h"
#include "client/http/range_client.h"

namespace selvage {

/// Parts of a pack that any web server serves, by HTTP Range: the front of the file with the directory first,
/// then the selected parts, neighbours in one request. Every byte is checked against the pack's own hashes,
/// so neither the server nor a proxy on the way is believed.
class HttpSource final : public PartSource {
 public:
  explicit HttpSource(std::string url, HttpOptions options = {});

  Result<std::shared_ptr<const Manifest>> open(std::stop_token stop = {}) override;
  /// Urgency means nothing to a web server.
  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token stop = {}) override;

 private:
  Result<void> read(std::uint64_t begin, std::uint64_t end, bool may_be_short, std::vector<std::byte>& into,
                    const std::stop_token& stop);

  std::string name_;
  HttpOptions options_;
  RangeClient ranges_;
};

}  // namespace selvage
