// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "client/app/server_options.h"
#include "client/fetch/model.h"

namespace CLI {
class App;
}

namespace selvage {

/// How a command gets at a model: connection, cache, patience and threads.
struct SourceOptions {
  ServerOptions server;
  std::string cache;  ///< a folder, or "off"; empty: the user's cache folder, if it can be used
  std::uint64_t cache_mib = kDefaultCacheBytes >> 20;
  double retry_seconds = 60;
  unsigned threads = 0;

  void add_to(CLI::App& command);
  /// Errors name the option: Io if a cache folder that was asked for cannot be used.
  Result<ModelOptions> model_options() const;
};

}  // namespace selvage
