// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/session/blocking_client.h"
#include "common/base/result.h"

namespace CLI {
class App;
}

namespace selvage {

/// How to talk to a server: the options that every subcommand with a HOST:PORT shares.
struct ServerOptions {
  bool tls = false;
  std::filesystem::path ca;          ///< implies tls
  std::filesystem::path token_file;  ///< its first line
  std::string token;                 ///< from the environment
  bool allow_plain = false;

  /// Adds them to a subcommand, which they must outlive.
  void add_to(CLI::App& command);
  /// Errors name the option or the file.
  Result<ClientOptions> client_options() const;
  /// Connects to HOST:PORT. Errors name it, or the option or the file.
  Result<BlockingClient> connect(const std::string& server, std::stop_token stop = {}) const;
};

}  // namespace selvage
