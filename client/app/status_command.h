// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "client/app/server_options.h"

namespace selvage {

/// `selvage-client status`: how a server is.
struct StatusCommand {
  std::string server;  ///< HOST:PORT
  bool json = false;
  ServerOptions connection;
};
Result<void> run(const StatusCommand& command);

}  // namespace selvage
