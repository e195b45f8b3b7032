// SPDX-License-Identifier: MIT
#include "client/app/verify_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/app/model_source.h"
#include "client/stitch/decode_limits.h"
#include "common/pack/pack.h"

namespace selvage {
namespace {

Result<void> verify_regions(const Pack& pack) {
  const Directory& directory = pack.directory();
  for (RegionId id = 0; id < directory.regions.size(); ++id) {
    const std::vector<LevelEntry>& levels = directory.regions[id].levels;
    for (std::uint8_t level = 0; level < levels.size(); ++level) {
      if (levels[level].is_repeat) continue;
      const PartRef& part = levels[level].part;
      const std::string where = fmt::format("region {} at level {}", id, level);
      if (auto ok = check_part(part, pack.part(part)); !ok) return forward_error(ok, where);
      auto mesh = decode_region(pack.part(part), decode_limits(directory, id, level));
      if (!mesh) return forward_error(mesh, where);
      if (auto ok = check_region_mesh(*mesh); !ok) return forward_error(ok, where);
    }
  }
  return {};
}

Result<void> verify_whole(const std::filesystem::path& path) {
  auto model = load_model(path.string());
  if (!model) return forward_error(model);
  const Directory& directory = model->directory;
  const TriangleSoup& soup = model->fetched.mesh.soup;
  if (soup.positions.size() != directory.vertices || soup.triangles.size() != directory.triangles) {
    return fail(
        ErrorCode::BadStream,
        fmt::format("{}: stitched to {} vertices and {} triangles, but the directory promises {} and {}",
                    path.string(), soup.positions.size(), soup.triangles.size(), directory.vertices,
                    directory.triangles));
  }
  for (const auto& [a, b, c] : soup.triangles) {
    if (a == b || b == c || c == a)
      return fail(ErrorCode::BadStream, path.string() + ": a stitched triangle repeats a vertex");
  }
  return {};
}

}  // namespace

Result<void> run(const VerifyCommand& command) {
  auto pack = Pack::open(command.pack);
  if (!pack) return forward_error(pack);
  auto ok = verify_regions(**pack);
  if (!ok) return forward_error(ok, command.pack.string());
  if (ok = verify_whole(command.pack); !ok) return ok;
  const Directory& directory = (*pack)->directory();
  if (command.json) {
    const nlohmann::ordered_json json = {{"pack", command.pack.string()},
                                         {"id", (*pack)->id().to_hex()},
                                         {"sound", true},
                                         {"regions", directory.real_region_count()},
                                         {"vertices", directory.vertices},
                                         {"triangles", directory.triangles}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}: sound; {} regions stitch to {} vertices and {} triangles\n", command.pack.string(),
               directory.real_region_count(), directory.vertices, directory.triangles);
  }
  return {};
}

}  // namespace selvage
