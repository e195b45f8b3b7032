// SPDX-License-Identifier: MIT
#include "client/app/get_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/app/model_source.h"
#include "common/base/progress_line.h"
#include "common/mesh_io/write_mesh.h"

namespace selvage {
namespace {

void print_json(const GetCommand& command, const FetchedModel& model) {
  const nlohmann::ordered_json json = {{"output", command.output.string()},
                                       {"model", model.directory.name},
                                       {"regions", model.regions},
                                       {"of_regions", model.directory.real_region_count()},
                                       {"vertices", model.mesh.soup.positions.size()},
                                       {"triangles", model.mesh.soup.triangles.size()},
                                       {"of_triangles", model.directory.triangles},
                                       {"parts", model.parts},
                                       {"part_bytes", model.part_bytes},
                                       {"directory_bytes", model.directory_bytes},
                                       {"seconds_to_first_region", model.time_to_first_region.count()},
                                       {"seconds_to_mesh", model.time_to_mesh.count()}};
  fmt::print("{}\n", json.dump(2));
}

void print_text(const GetCommand& command, const FetchedModel& model) {
  fmt::print("{}: {} vertices, {} of {} triangles, {} of {} regions\n", command.output.string(),
             model.mesh.soup.positions.size(), model.mesh.soup.triangles.size(), model.directory.triangles,
             model.regions, model.directory.real_region_count());
  fmt::print(
      "  {} bytes in {} parts, and {} of directory; first region after {:.1f} ms, stitched after {:.1f} ms\n",
      model.part_bytes, model.parts, model.directory_bytes, 1e3 * model.time_to_first_region.count(),
      1e3 * model.time_to_mesh.count());
}

}  // namespace

Result<void> run(const GetCommand& command) {
  auto selection = command.selection.selection();
  if (!selection) return forward_error(selection);
  auto connection = command.connection.client_options();
  if (!connection) return forward_error(connection);
  const FetchOptions options{*selection, command.threads, *connection};
  ProgressLine line;
  auto model =
      command.from_pack
          ? fetch_from_pack(command.source, options)
          : fetch_from_server(command.source, options,
                              [&](std::uint32_t parts, std::uint32_t of, std::uint64_t bytes) {
                                line.show(fmt::format("{} of {} parts, {} KiB", parts, of, bytes / 1024));
                              });
  line.wipe();
  if (!model) return forward_error(model);
  if (auto ok = write_mesh(command.output, model->mesh.soup, {.comment = provenance(model->directory)}); !ok)
    return ok;
  if (command.json) {
    print_json(command, *model);
  } else {
    print_text(command, *model);
  }
  return {};
}

}  // namespace selvage
