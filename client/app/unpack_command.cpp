// SPDX-License-Identifier: MIT
#include "client/app/unpack_command.h"

#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "client/stitch/part_collector.h"
#include "common/base/parallel.h"
#include "common/mesh_io/write_mesh.h"

namespace selvage {

std::string provenance(const Directory& directory) {
  const Grid& grid = directory.grid;
  return fmt::format("selvage model {}, grid of {} bits, step {}, origin {} {} {}", directory.name, grid.bits,
                     grid.step, grid.origin.x, grid.origin.y, grid.origin.z);
}

Result<StitchedMesh> decode_pack(const Pack& pack, const Selection& selection, unsigned threads) {
  auto parts = select_parts(pack.directory(), selection);
  if (!parts) return forward_error(parts);
  PartCollector collector(pack.directory());
  std::mutex mutex;
  std::optional<Error> failure;
  threaded_for(threads)(parts->size(), [&](std::size_t i) {
    const PartRef& ref = *pack.directory().find((*parts)[i]);
    auto ok = check_part(ref, pack.part(ref));
    if (ok) ok = collector.add((*parts)[i], pack.part(ref));
    const std::scoped_lock lock(mutex);
    if (!ok && !failure) failure = std::move(ok.error());
  });
  if (failure) return tl::unexpected(std::move(*failure));
  return collector.mesh();
}

Result<void> run(const UnpackCommand& command) {
  auto selection = command.selection.selection();
  if (!selection) return forward_error(selection);
  auto pack = Pack::open(command.pack);
  if (!pack) return forward_error(pack);
  auto mesh = decode_pack(**pack, *selection, command.threads);
  if (!mesh) return forward_error(mesh, command.pack.string());
  if (auto ok = write_mesh(command.output, mesh->soup, {.comment = provenance((*pack)->directory())}); !ok)
    return ok;
  fmt::print("{}: {} vertices, {} triangles\n", command.output.string(), mesh->soup.positions.size(),
             mesh->soup.triangles.size());
  return {};
}

}  // namespace selvage
