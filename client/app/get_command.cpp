// SPDX-License-Identifier: MIT
#include "client/app/get_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/app/model_source.h"
#include "common/base/stop_on_interrupt.h"
#include "common/mesh_io/write_mesh.h"

namespace selvage {
namespace {

void print_json(const GetCommand& command, const LoadedModel& model) {
  const FetchedModel& got = model.fetched;
  const nlohmann::ordered_json json = {
      {"output", command.output.string()},
      {"model", model.directory.name},
      {"regions", got.regions},
      {"regions_at_level", model.regions_at_level},
      {"max_error", model.largest_error},
      {"of_regions", model.directory.real_region_count()},
      {"vertices", got.mesh.soup.positions.size()},
      {"triangles", got.mesh.soup.triangles.size()},
      {"of_triangles", model.directory.triangles},
      {"parts", got.parts + got.cached_parts},
      {"part_bytes", got.bytes + got.cached_bytes},
      {"cached_parts", got.cached_parts},
      {"cached_bytes", got.cached_bytes},
      {"directory_bytes", model.directory_bytes},
      {"retries", got.retries},
      {"seconds_to_first_region", (model.time_to_open + got.time_to_first_region).count()},
      {"seconds_to_mesh", (model.time_to_open + got.time_to_mesh).count()}};
  fmt::print("{}\n", json.dump(2));
}

void print_text(const GetCommand& command, const LoadedModel& model) {
  const FetchedModel& got = model.fetched;
  fmt::print("{}: {} vertices, {} of {} triangles, {} of {} regions\n", command.output.string(),
             got.mesh.soup.positions.size(), got.mesh.soup.triangles.size(), model.directory.triangles,
             got.regions, model.directory.real_region_count());
  if (model.regions_at_level.size() > 1) {
    std::string levels;
    for (std::size_t level = 0; level < model.regions_at_level.size(); ++level)
      levels += fmt::format("{}{} at level {}", level > 0 ? ", " : "", model.regions_at_level[level], level);
    fmt::print("  regions: {}; at most {:.3g} model units off\n", levels, model.largest_error);
  }
  fmt::print("  {} bytes in {} parts, and {} of directory", got.bytes, got.parts, model.directory_bytes);
  if (got.cached_parts > 0)
    fmt::print("; {} bytes in {} parts were cached", got.cached_bytes, got.cached_parts);
  if (got.retries > 0) fmt::print("; connected again {} times", got.retries);
  fmt::print("\n  first region after {:.1f} ms, stitched after {:.1f} ms\n",
             1e3 * (model.time_to_open + got.time_to_first_region).count(),
             1e3 * (model.time_to_open + got.time_to_mesh).count());
}

}  // namespace

Result<void> run(const GetCommand& command) {
  // Before anything is fetched: what would fail at the end anyway.
  if (auto ok = check_writable(command.output); !ok) return ok;
  const StopOnInterrupt interrupt;
  auto model = load_model(command.source, command.selection, command.options, interrupt.token());
  if (!model) return forward_error(model);
  auto ok = write_mesh(command.output, model->fetched.mesh.soup, {.comment = provenance(model->directory)});
  if (!ok) return ok;
  if (command.json) {
    print_json(command, *model);
  } else {
    print_text(command, *model);
  }
  return {};
}

}  // namespace selvage
