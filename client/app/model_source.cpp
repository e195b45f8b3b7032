// SPDX-License-Identifier: MIT
#include "client/app/model_source.h"

#include <fmt/format.h>

#include "client/app/progress_bar.h"

namespace selvage {

Result<LoadedModel> load_model(const std::string& source, const Selection& selection,
                               const SourceOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  auto model_options = options.model_options();
  if (!model_options) return forward_error(model_options);
  auto model = Model::open(source, std::move(*model_options));
  if (!model) return forward_error(model);
  LoadedModel loaded{
      model->directory(), model->directory_bytes(), {}, std::chrono::steady_clock::now() - begin};

  ProgressBar bar;
  FetchEvents events;
  events.on_progress = [&](const FetchProgress& progress) { bar.show(progress); };
  events.on_retry = [&](const Error& error, auto delay) { bar.show_retry(error, delay); };
  auto fetched = model->fetch(selection, std::move(events)).wait();
  bar.wipe();
  if (!fetched) return forward_error(fetched);
  loaded.fetched = std::move(*fetched);
  return loaded;
}

Result<Directory> load_directory(const std::string& source, const ServerOptions& options) {
  auto connection = options.client_options();
  if (!connection) return forward_error(connection);
  ModelOptions model_options;
  model_options.connection = std::move(*connection);
  auto model = Model::open(source, std::move(model_options));
  if (!model) return forward_error(model);
  return model->directory();
}

std::string provenance(const Directory& directory) {
  const Grid& grid = directory.grid;
  return fmt::format("selvage model {}, grid of {} bits, step {}, origin {} {} {}", directory.name, grid.bits,
                     grid.step, grid.origin.x, grid.origin.y, grid.origin.z);
}

}  // namespace selvage
