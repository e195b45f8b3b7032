// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "common/base/log.h"
#include "common/net/tls.h"
#include "server/publish/publisher.h"
#include "server/session/limits.h"

namespace CLI {
class App;
}

namespace selvage {

/// Everything that an operator may set, on the command line or in a file (toml_config.h); docs/OPERATIONS.md
/// explains each.
struct ServerOptions {
  std::filesystem::path store;
  std::string listen = "127.0.0.1:7878";
  std::filesystem::path port_file;
  TlsServerFiles tls;  ///< both or none
  bool allow_plain = false;
  std::filesystem::path tokens;
  std::string health;  ///< HOST:PORT; empty: none
  unsigned threads = 0;
  std::string congestion_control;  ///< empty: the system's
  bool verbose = false;
  bool quiet = false;
  LogFormat log_format = LogFormat::Text;
  std::chrono::milliseconds store_poll{10'000};
  ServerLimits limits;
  PublishLimits publish;

  bool is_encrypted() const { return !tls.certificate.empty(); }
  LogLevel log_level() const {
    return verbose ? LogLevel::Debug : quiet ? LogLevel::Warning : LogLevel::Info;
  }
};

/// `options` outlives the app.
void add_options(CLI::App& app, ServerOptions& options);

}  // namespace selvage
