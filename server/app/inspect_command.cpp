// SPDX-License-Identifier: MIT
#include "server/app/inspect_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/pack/pack.h"

namespace selvage {
namespace {

/// Bytes of a pack by purpose; they sum to the file.
struct ByteShares {
  std::size_t connectivity = 0, attributes = 0, coarser = 0, joins = 0, headers = 0, directory = 0;
};

ByteShares measure(const Pack& pack) {
  const Directory& directory = pack.directory();
  ByteShares shares;
  shares.directory = kPackHeaderSize + pack.directory_bytes().size();
  shares.connectivity = directory.connectivity_bytes;
  for (const RegionEntry& entry : directory.regions) {
    shares.joins += entry.bundle.size;
    for (const LevelEntry& level : entry.levels) {
      if (level.is_repeat) continue;
      if (&level != &entry.levels.front()) {
        shares.coarser += level.part.size;
      } else {
        shares.headers += 1;
        shares.attributes += level.part.size - 1;
      }
    }
  }
  shares.attributes -= std::min(shares.attributes, shares.connectivity);
  return shares;
}

nlohmann::ordered_json region_json(RegionId id, const RegionEntry& entry, const Grid& grid) {
  const Vec3 low = grid.position(entry.box_min), high = grid.position(entry.box_max);
  nlohmann::ordered_json json = {{"region", id},
                                 {"box", {low.x, low.y, low.z, high.x, high.y, high.z}},
                                 {"loops", entry.loop_lengths},
                                 {"lower_neighbours", entry.lower_neighbours},
                                 {"bundle_triangles", entry.bundle_triangles},
                                 {"bundle_bytes", entry.bundle.size}};
  for (const LevelEntry& level : entry.levels) {
    json["levels"].push_back({{"vertices", level.vertices},
                              {"triangles", level.triangles},
                              {"deviation", level.deviation},
                              {"bits", grid.bits - level.dropped_bits},
                              {"repeats_finer", level.is_repeat},
                              {"bytes", level.part.size},
                              {"hash", level.part.hash.to_hex()}});
  }
  return json;
}

void print_json(const Pack& pack, const ByteShares& shares) {
  const Directory& directory = pack.directory();
  const Grid& grid = directory.grid;
  nlohmann::ordered_json json = {
      {"name", directory.name},
      {"id", pack.id().to_hex()},
      {"format", {{"major", pack.header().major}, {"minor", pack.header().minor}}},
      {"units", directory.units},
      {"metadata", directory.metadata},
      {"grid",
       {{"bits", grid.bits}, {"step", grid.step}, {"origin", {grid.origin.x, grid.origin.y, grid.origin.z}}}},
      {"vertices", directory.vertices},
      {"triangles", directory.triangles},
      {"boundary_triangles", directory.boundary_triangles},
      {"source",
       {{"vertices", directory.source.vertices},
        {"triangles", directory.source.triangles},
        {"dropped_triangles", directory.source.dropped_triangles},
        {"unreferenced_vertices", directory.source.unreferenced_vertices},
        {"flipped_triangles", directory.source.flipped_triangles},
        {"cut_vertices", directory.source.cut_vertices}}},
      {"bytes",
       {{"total", pack.bytes().size()},
        {"connectivity", shares.connectivity},
        {"attributes", shares.attributes},
        {"coarser_levels", shares.coarser},
        {"joins", shares.joins},
        {"headers", shares.headers},
        {"directory", shares.directory}}},
      {"names", nlohmann::ordered_json::object()},
      {"regions", nlohmann::ordered_json::array()}};
  for (const NamedRegions& named : directory.names) {
    for (const auto& [first, last] : named.ranges) json["names"][named.name].push_back({first, last});
  }
  for (RegionId id = 0; id < directory.regions.size(); ++id) {
    if (!directory.regions[id].levels.empty())
      json["regions"].push_back(region_json(id, directory.regions[id], grid));
  }
  fmt::print("{}\n", json.dump(2));
}

void print_share(const char* what, std::size_t bytes, const Pack& pack) {
  fmt::print("  {:<24}{:>12} bytes {:>8.3f} bits a vertex {:>6.1f} %\n", what, bytes,
             8.0 * static_cast<double>(bytes) / std::max(pack.directory().vertices, 1u),
             100.0 * static_cast<double>(bytes) / static_cast<double>(pack.bytes().size()));
}

void print_text(const Pack& pack, const ByteShares& shares) {
  const Directory& directory = pack.directory();
  fmt::print("{}  (pack {}, format {}.{})\n", directory.name, pack.id().to_hex(), pack.header().major,
             pack.header().minor);
  fmt::print("{} vertices, {} triangles, {} regions, {} boundary triangles\n", directory.vertices,
             directory.triangles, directory.real_region_count(), directory.boundary_triangles);
  fmt::print("grid of {} bits, step {:.6g} {}\n\n", directory.grid.bits, directory.grid.step,
             directory.units.empty() ? "model units" : directory.units);
  print_share("connectivity", shares.connectivity, pack);
  print_share("geometry", shares.attributes, pack);
  print_share("coarser levels", shares.coarser, pack);
  print_share("joins", shares.joins, pack);
  print_share("region headers", shares.headers, pack);
  print_share("directory", shares.directory, pack);
  print_share("total", pack.bytes().size(), pack);
  print_share("connectivity and joins", shares.connectivity + shares.joins, pack);
  fmt::print("\n{:>7} {:>9} {:>10} {:>9} {:>9} {:>7}  {}\n", "region", "vertices", "triangles", "bytes",
             "joins", "loops", "lower neighbours");
  for (RegionId id = 0; id < directory.regions.size(); ++id) {
    const RegionEntry& entry = directory.regions[id];
    if (entry.levels.empty()) continue;
    const LevelEntry& full = entry.levels.front();
    fmt::print("{:>7} {:>9} {:>10} {:>9} {:>9} {:>7}  {}\n",
               id == kLooseRegion ? "loose" : std::to_string(id), full.vertices, full.triangles,
               full.part.size, entry.bundle.size, entry.loop_lengths.size(),
               fmt::join(entry.lower_neighbours, " "));
    for (std::size_t k = 1; k < entry.levels.size(); ++k) {
      const LevelEntry& level = entry.levels[k];
      const std::string at = fmt::format("@{}", k);
      if (level.is_repeat) {
        fmt::print("{:>7} {:>9}\n", at, "the same");
      } else {
        fmt::print("{:>7} {:>9} {:>10} {:>9}  {} bits, at most {:.3g} off\n", at, level.vertices,
                   level.triangles, level.part.size, directory.grid.bits - level.dropped_bits,
                   level.deviation);
      }
    }
  }
}

}  // namespace

Result<void> run(const InspectCommand& command) {
  auto pack = Pack::open(command.pack);
  if (!pack) return forward_error(pack);
  const ByteShares shares = measure(**pack);
  if (command.json) {
    print_json(**pack, shares);
  } else {
    print_text(**pack, shares);
  }
  return {};
}

}  // namespace selvage
