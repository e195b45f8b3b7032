// SPDX-License-Identifier: MIT
#include "client/app/model_source.h"

#include <algorithm>

#include <fmt/format.h>

#include "client/app/progress_bar.h"
#include "common/pack/level_choice.h"

namespace selvage {
namespace {

/// Whether the options say what to ask for to one who knows nothing of the model.
bool is_settled(const SelectionOptions& options, const Selection& selection) {
  return !options.max_error && !options.budget && selection.names.empty() && selection.name_levels.empty();
}

/// Names resolved, levels chosen.
Result<Selection> settle(const Directory& directory, const SelectionOptions& options) {
  auto named = options.selection();
  if (!named) return named;
  auto selection = resolve_names(directory, std::move(*named));
  if (!selection) return selection;
  if (options.max_error) return choose_by_error(directory, std::move(*selection), *options.max_error);
  if (options.budget) return choose_by_budget(directory, std::move(*selection), *options.budget);
  return selection;
}

void count_levels(const std::vector<PartId>& parts, LoadedModel& model) {
  model.regions_at_level.assign(model.directory.level_count(), 0);
  for (const PartId& id : parts) {
    if (id.kind != PartKind::Region || id.region == kLooseRegion) continue;
    ++model.regions_at_level[id.level];
    model.largest_error = std::max(model.largest_error, level_error(model.directory, id.region, id.level));
  }
}

}  // namespace

Result<Model> open_model(const std::string& source, const SourceOptions& options, std::stop_token stop) {
  auto model_options = options.model_options();
  if (!model_options) return forward_error(model_options);
  return Model::open(source, std::move(*model_options), std::move(stop));
}

Result<LoadedModel> load_selection(Model& model, const Selection& selection, std::stop_token stop) {
  ProgressBar bar;
  FetchEvents events;
  events.on_progress = [&](const FetchProgress& progress) { bar.show(progress); };
  events.on_retry = [&](const Error& error, auto delay) { bar.show_retry(error, delay); };
  Fetch fetch = model.fetch(selection, std::move(events));
  const std::stop_callback cancels(stop, [&] { fetch.cancel(); });
  auto fetched = fetch.wait();
  bar.wipe();
  if (!fetched) return forward_error(fetched);

  LoadedModel loaded;
  loaded.directory = model.directory();
  loaded.directory_bytes = model.directory_bytes();
  loaded.fetched = std::move(*fetched);
  auto parts = select_parts(loaded.directory, selection);
  if (!parts) return forward_error(parts);
  count_levels(*parts, loaded);
  return loaded;
}

Result<LoadedModel> load_model(const std::string& source, const SelectionOptions& selection,
                               const SourceOptions& options, std::stop_token stop) {
  // Malformed options are told before anything is opened.
  auto said = selection.selection();
  if (!said) return forward_error(said);
  if (is_settled(selection, *said)) {
    auto model_options = options.model_options();
    if (!model_options) return forward_error(model_options);
    auto model = Model::at(source, std::move(*model_options));
    if (!model) return forward_error(model);
    return load_selection(*model, *said, stop);
  }
  const auto begin = std::chrono::steady_clock::now();
  auto model = open_model(source, options, stop);
  if (!model) return forward_error(model);
  const std::chrono::duration<double> time_to_open = std::chrono::steady_clock::now() - begin;
  auto settled = settle(model->directory(), selection);
  if (!settled) return forward_error(settled, source);
  auto loaded = load_selection(*model, *settled, stop);
  if (loaded) loaded->time_to_open = time_to_open;
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
