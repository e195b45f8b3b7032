// SPDX-License-Identifier: MIT
#include "client/app/source_options.h"

#include <CLI/CLI.hpp>

namespace selvage {

void SourceOptions::add_to(CLI::App& command) {
  server.add_to(command);
  command
      .add_option("--cache", cache,
                  "where fetched parts are kept for the next time: a folder, or off "
                  "(default: $XDG_CACHE_HOME/selvage or ~/.cache/selvage)")
      ->type_name("DIR|off");
  command.add_option("--cache-size", cache_mib, "MiB that the cache may take up")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 30))
      ->capture_default_str();
  command
      .add_option("--retry-for", retry_seconds,
                  "seconds to go on trying to connect again when a connection breaks; 0: never")
      ->check(CLI::Range(0.0, 86'400.0))
      ->capture_default_str();
  command.add_option("--threads", threads, "that decode; 0: all cores")->capture_default_str();
}

Result<ModelOptions> SourceOptions::model_options() const {
  ModelOptions options;
  auto connection = server.client_options();
  if (!connection) return forward_error(connection);
  options.connection = std::move(*connection);
  options.cache_bytes = cache_mib << 20;
  options.decode_threads = threads;
  options.retry.give_up_after = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * retry_seconds));
  if (cache == "off") return options;
  options.cache_folder = cache.empty() ? default_cache_folder() : cache;
  if (!options.cache_folder) return options;
  auto opened = PartCache::open(*options.cache_folder, options.cache_bytes);
  if (opened) return options;
  // Nobody asked for the usual folder by name: without a home, or with a read-only one, there is no cache.
  if (!cache.empty()) return forward_error(opened, "--cache");
  options.cache_folder.reset();
  return options;
}

}  // namespace selvage
