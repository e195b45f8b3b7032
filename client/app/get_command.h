// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/app/selection_options.h"
#include "client/app/server_options.h"

namespace selvage {

/// `selvage-client get` and `unpack`: chosen regions, decoded and stitched, as one mesh file.
struct GetCommand {
  std::string source;      ///< get: HOST:PORT/MODEL; unpack: a pack
  bool from_pack = false;  ///< unpack
  std::filesystem::path output;
  SelectionOptions selection;
  unsigned threads = 0;
  bool json = false;
  ServerOptions connection;  ///< of get
};

Result<void> run(const GetCommand& command);

}  // namespace selvage
