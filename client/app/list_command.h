// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "client/app/server_options.h"
#include "common/base/result.h"

namespace selvage {

/// `selvage-client list`: the models of a server.
struct ListCommand {
  std::string server;  ///< HOST:PORT
  bool json = false;
  ServerOptions connection;
};
Result<void> run(const ListCommand& command);

/// `selvage-client regions`: the regions of one model, on a server or in a pack.
struct RegionsCommand {
  std::string source;  ///< HOST:PORT/MODEL or a pack
  bool json = false;
  ServerOptions connection;
};
Result<void> run(const RegionsCommand& command);

}  // namespace selvage
