// SPDX-License-Identifier: MIT
//
// How the tool's commands load a model, or the regions of one that they were told: from wherever it is, with
// a progress bar on a terminal.
#pragma once

#include <chrono>
#include <string>

#include "client/app/source_options.h"
#include "client/fetch/model.h"

namespace selvage {

struct LoadedModel {
  Directory directory;
  std::uint64_t directory_bytes = 0;
  FetchedModel fetched;
  std::chrono::duration<double>
      time_to_open{};  ///< until the directory was there; `fetched` counts from then
};

/// `source` as in Model::open. Errors name it.
Result<LoadedModel> load_model(const std::string& source, const Selection& selection = {},
                               const SourceOptions& options = {});

/// The directory alone.
Result<Directory> load_directory(const std::string& source, const ServerOptions& options = {});

/// The line that every written mesh carries where its format has comments.
std::string provenance(const Directory& directory);

}  // namespace selvage
