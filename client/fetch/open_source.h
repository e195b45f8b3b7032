// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "client/session/part_source.h"
#include "client/session/client_options.h"

namespace selvage {

struct OpenedSource {
  std::unique_ptr<PartSource> source;
  bool is_remote = false;  ///< worth a cache
};

/// What a text names: a pack that exists, http:// or https://, or HOST:PORT/MODEL. Touches no network.
Result<OpenedSource> open_source(const std::string& text, const ClientOptions& connection);

}  // namespace selvage
