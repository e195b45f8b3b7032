// SPDX-License-Identifier: MIT
#include "client/app/server_options.h"

#include <fstream>

#include <CLI/CLI.hpp>

namespace selvage {

void ServerOptions::add_to(CLI::App& command) {
  const std::string group = "Connection";
  command.add_flag("--tls", tls, "encrypt, and make sure that the server is who it says it is")->group(group);
  command.add_option("--ca", ca, "trust the authorities in this PEM file, not the system's; implies --tls")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--token-file", token_file, "the token that the server wants is this file's first line")
      ->type_name("FILE")
      ->group(group);
  // On the command line others on this machine could read it.
  command.add_option("--token", token, "the token itself; better through the environment")
      ->envname("SELVAGE_TOKEN")
      ->group("");
  command.add_flag("--allow-plain", allow_plain, "send the token to another machine even without TLS")
      ->group(group);
}

Result<ClientOptions> ServerOptions::client_options() const {
  ClientOptions options;
  options.software = "selvage-client";
  if (tls || !ca.empty()) options.tls = TlsTrust{ca};
  options.token = token;
  options.allow_plain = allow_plain;
  if (!token_file.empty()) {
    std::ifstream file(token_file);
    if (!std::getline(file, options.token) || options.token.empty()) {
      return fail(ErrorCode::BadFile, token_file.string() + ": has no token in its first line");
    }
    if (options.token.ends_with('\r')) options.token.pop_back();
  }
  return options;
}

Result<BlockingClient> ServerOptions::connect(const std::string& server, std::stop_token stop) const {
  auto options = client_options();
  if (!options) return forward_error(options);
  return connect_to(server, std::move(*options), std::move(stop));
}

}  // namespace selvage
