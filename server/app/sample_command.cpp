// SPDX-License-Identifier: MIT
#include "server/app/sample_command.h"

#include <fmt/format.h>

#include "common/mesh_io/write_mesh.h"
#include "common/samples/samples.h"

namespace selvage {

Result<void> run(const SampleCommand& command) {
  if (command.name.empty()) {
    for (const std::string& name : sample_names()) fmt::print("{:<12}{}\n", name, describe_sample(name));
    return {};
  }
  auto soup = make_sample(command.name, command.triangles);
  if (!soup) return forward_error(soup);
  std::filesystem::path path = command.output;
  if (path.empty()) path = command.name + ".ply";
  if (auto ok = write_mesh(path, *soup, {.comment = "selvage sample " + command.name}); !ok) return ok;
  fmt::print("{}: {} vertices, {} triangles\n", path.string(), soup->positions.size(),
             soup->triangles.size());
  return {};
}

}  // namespace selvage
