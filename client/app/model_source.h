// SPDX-License-Identifier: MIT
//
// How the tool's commands load a model, or the regions of one that they were told: from wherever it is, with
// a progress bar on a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "client/app/selection_options.h"
#include "client/app/source_options.h"
#include "client/fetch/model.h"

namespace selvage {

struct LoadedModel {
  Directory directory;
  std::uint64_t directory_bytes = 0;
  FetchedModel fetched;
  std::vector<std::uint32_t> regions_at_level;  ///< of those fetched, up to the coarsest level there is
  double largest_error = 0;                     ///< of them, in model units, see level_error
  std::chrono::duration<double>
      time_to_open{};  ///< until the directory was there; `fetched` counts from then
};

/// Opens and fetches what was selected, with progress on a terminal. `source` as in Model::open. Errors name
/// it. Cancelled soon after `stop`.
Result<LoadedModel> load_model(const std::string& source, const SelectionOptions& selection = {},
                               const SourceOptions& options = {}, std::stop_token stop = {});

/// The same of a model that is open already; time_to_open stays 0.
Result<LoadedModel> load_selection(Model& model, const Selection& selection, std::stop_token stop = {});

Result<Model> open_model(const std::string& source, const SourceOptions& options, std::stop_token stop = {});

/// The directory alone.
Result<Directory> load_directory(const std::string& source, const ServerOptions& options = {});

/// The line that every written mesh carries where its format has comments.
std::string provenance(const Directory& directory);

}  // namespace selvage
