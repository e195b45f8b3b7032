// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/app/server_options.h"
#include "common/net/publish_cut.h"

namespace selvage {

/// `selvage-client publish`: a mesh file becomes a model of a server.
struct PublishCommand {
  std::string server;  ///< HOST:PORT
  std::filesystem::path model;
  std::string name;  ///< empty: the file's stem
  std::string units;
  int bits = 14;
  bool lossless = false;
  bool replace = false;
  PublishCut cut;
  double retry_seconds = 60;  ///< of failing with nothing getting through; 0: never try again
  bool json = false;
  ServerOptions connection;
};
Result<void> run(const PublishCommand& command);

/// `selvage-client unpublish`: a model of a server goes.
struct UnpublishCommand {
  std::string server;
  std::string name;
  ServerOptions connection;
};
Result<void> run(const UnpublishCommand& command);

}  // namespace selvage
