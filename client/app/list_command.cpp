// SPDX-License-Identifier: MIT
#include "client/app/list_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/app/model_source.h"
#include "client/fetch/list_models.h"

namespace selvage {
namespace {

nlohmann::ordered_json to_json(const ModelInfo& model) {
  if (!model.problem.empty()) return {{"name", model.name}, {"problem", model.problem}};
  return {{"name", model.name},       {"id", model.pack_id.to_hex()}, {"bytes", model.size_bytes},
          {"regions", model.regions}, {"vertices", model.vertices},   {"triangles", model.triangles}};
}

nlohmann::ordered_json to_json(RegionId id, const RegionEntry& entry, const Grid& grid) {
  const Vec3 low = grid.position(entry.box_min), high = grid.position(entry.box_max);
  auto levels = nlohmann::ordered_json::array();
  for (const LevelEntry& level : entry.levels) {
    levels.push_back({{"vertices", level.vertices},
                      {"triangles", level.triangles},
                      {"bytes", level.part.size},
                      {"deviation", level.deviation},
                      {"bits", grid.bits - level.dropped_bits},
                      {"repeats_finer", level.is_repeat}});
  }
  return {{"region", id},
          {"vertices", entry.levels[0].vertices},
          {"triangles", entry.levels[0].triangles},
          {"bytes", entry.levels[0].part.size},
          {"box", {low.x, low.y, low.z, high.x, high.y, high.z}},
          {"lower_neighbours", entry.lower_neighbours},
          {"levels", levels}};
}

/// As --regions takes it: "3,5-7".
std::string to_text(const std::vector<RegionRange>& ranges) {
  std::string text;
  for (const auto& [first, last] : ranges) {
    if (!text.empty()) text += ',';
    text += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
  }
  return text;
}

}  // namespace

Result<void> run(const ListCommand& command) {
  auto options = command.connection.client_options();
  if (!options) return forward_error(options);
  auto models = list_models(command.server, *options);
  if (!models) return forward_error(models);
  if (command.json) {
    auto json = nlohmann::ordered_json::array();
    for (const ModelInfo& model : *models) json.push_back(to_json(model));
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{:<24} {:>8} {:>10} {:>10} {:>12}\n", "model", "regions", "vertices", "triangles", "bytes");
  for (const ModelInfo& model : *models) {
    if (model.problem.empty()) {
      fmt::print("{:<24} {:>8} {:>10} {:>10} {:>12}\n", model.name, model.regions, model.vertices,
                 model.triangles, model.size_bytes);
    } else {
      fmt::print("{:<24} cannot be opened: {}\n", model.name, model.problem);
    }
  }
  return {};
}

Result<void> run(const RegionsCommand& command) {
  auto directory = load_directory(command.source, command.connection);
  if (!directory) return forward_error(directory);
  if (command.json) {
    auto json = nlohmann::ordered_json::array();
    for (RegionId id = 1; id < directory->regions.size(); ++id)
      json.push_back(to_json(id, directory->regions[id], directory->grid));
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{:>7} {:>9} {:>10} {:>9}  {}\n", "region", "vertices", "triangles", "bytes",
             "box (model units)");
  for (RegionId id = 1; id < directory->regions.size(); ++id) {
    const RegionEntry& entry = directory->regions[id];
    const Vec3 low = directory->grid.position(entry.box_min), high = directory->grid.position(entry.box_max);
    fmt::print("{:>7} {:>9} {:>10} {:>9}  {:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g}\n", id,
               entry.levels[0].vertices, entry.levels[0].triangles, entry.levels[0].part.size, low.x, low.y,
               low.z, high.x, high.y, high.z);
    for (std::size_t k = 1; k < entry.levels.size(); ++k) {
      const LevelEntry& level = entry.levels[k];
      const std::string at = fmt::format("@{}", k);
      if (level.is_repeat) {
        fmt::print("{:>7} {:>9}\n", at, "the same");
        continue;
      }
      fmt::print("{:>7} {:>9} {:>10} {:>9}  {} bits, at most {:.3g} off\n", at, level.vertices,
                 level.triangles, level.part.size, directory->grid.bits - level.dropped_bits,
                 level.deviation);
    }
  }
  for (const NamedRegions& named : directory->names)
    fmt::print("{}: {}\n", named.name, to_text(named.ranges));
  return {};
}

}  // namespace selvage
