// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/app/selection_options.h"
#include "client/app/source_options.h"

namespace selvage {

/// `selvage-client get` and `unpack`: chosen regions, decoded and stitched, as one mesh file.
struct GetCommand {
  std::string source;  ///< HOST:PORT/MODEL, a URL, or a pack
  std::filesystem::path output;
  SelectionOptions selection;
  SourceOptions options;
  bool json = false;
};

Result<void> run(const GetCommand& command);

}  // namespace selvage
