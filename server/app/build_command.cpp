// SPDX-License-Identifier: MIT
#include "server/app/build_command.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "common/base/progress_line.h"
#include "common/base/replace_file.h"
#include "common/base/stop_on_interrupt.h"
#include "common/mesh_io/read_mesh.h"
#include "common/pack/pack.h"
#include "server/ingest/ingest.h"
#include "server/ingest/repair_notes.h"

namespace selvage {
namespace {

std::filesystem::path output_path(const BuildCommand& command) {
  if (!command.pack.empty()) return command.pack;
  return command.store / (command.segmentation.model.stem().string() + ".selvage");
}

/// What the whole model takes at one level, joins at full resolution included.
struct LevelTotal {
  std::uint64_t triangles = 0, bytes = 0;
  double deviation = 0;
};
std::vector<LevelTotal> totals_by_level(const Directory& directory) {
  std::vector<LevelTotal> totals(directory.level_count());
  for (std::uint32_t level = 0; level < totals.size(); ++level) {
    for (const RegionEntry& entry : directory.regions) {
      totals[level].bytes += entry.bundle.size;
      if (entry.levels.empty()) continue;
      const LevelEntry& at = entry.levels[entry.canonical_level(level)];
      totals[level].triangles += at.triangles;
      totals[level].bytes += at.part.size;
      totals[level].deviation = std::max(totals[level].deviation, double{at.deviation});
    }
  }
  return totals;
}

std::string count_of(std::uint32_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void print_repair(const RepairReport& report, const std::string& file) {
  for (const std::string& note : notes_of(report)) fmt::print(stderr, "{}: {}\n", file, note);
}

void print_json(const BuildCommand& command, const std::filesystem::path& path, const IngestedModel& model,
                const Pack& pack) {
  const Directory& directory = pack.directory();
  nlohmann::ordered_json json = {
      {"pack", path.string()},
      {"id", pack.id().to_hex()},
      {"name", directory.name},
      {"bytes", pack.bytes().size()},
      {"bits", command.bits},
      {"regions", model.regions},
      {"names", model.names},
      {"vertices", directory.vertices},
      {"triangles", directory.triangles},
      {"boundary_triangles", directory.boundary_triangles},
      {"loose_vertices", model.loose_vertices},
      {"dropped_triangles", model.repair.dropped_triangles},
      {"unreferenced_vertices", model.repair.unreferenced_vertices},
      {"turned_triangles", model.repair.turned_triangles},
      {"vertex_copies", model.repair.vertex_copies},
  };
  for (const LevelTotal& total : totals_by_level(directory)) {
    json["levels"].push_back({{"region_triangles", total.triangles},
                              {"bytes_with_joins", total.bytes},
                              {"deviation", total.deviation}});
  }
  for (const StageTime& time : model.times) json["seconds"][time.stage] = time.seconds.count();
  fmt::print("{}\n", json.dump(2));
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void print_summary(const std::filesystem::path& path, const IngestedModel& model, const Pack& pack) {
  const Directory& directory = pack.directory();
  const auto bytes = static_cast<double>(pack.bytes().size());
  double total = 0;
  std::string stages;
  for (const StageTime& time : model.times) {
    total += time.seconds.count();
    stages += fmt::format("{}{} {:.3f}", stages.empty() ? "" : ", ", time.stage, time.seconds.count());
  }
  fmt::print("{}\n", path.string());
  fmt::print("  {} vertices, {} triangles in {}, {} boundary triangles ({:.1f} %)\n", directory.vertices,
             directory.triangles, count_of(model.regions, "region", "regions"), directory.boundary_triangles,
             100.0 * directory.boundary_triangles / std::max(directory.triangles, 1u));
  if (model.names > 0) {
    fmt::print("  {}, for instance {}; selvage-client get --regions NAME\n",
               count_of(model.names, "name", "names"), directory.names.front().name);
  }
  fmt::print("  {} bytes, {:.2f} bits a vertex on a {}-bit grid\n", pack.bytes().size(),
             8 * bytes / std::max(directory.vertices, 1u), directory.grid.bits);
  const std::vector<LevelTotal> totals = totals_by_level(directory);
  for (std::size_t level = 1; level < totals.size(); ++level) {
    fmt::print(
        "  level {}: {} triangles inside regions ({:.1f} %), {} bytes with joins, at most {:.3g} off\n",
        level, totals[level].triangles,
        100.0 * static_cast<double>(totals[level].triangles) /
            static_cast<double>(std::max<std::uint64_t>(totals[0].triangles, 1)),
        totals[level].bytes, totals[level].deviation);
  }
  fmt::print("  {:.3f} s ({}), peak memory {:.0f} MiB\n", total, stages, peak_memory_mib());
}

}  // namespace

Result<void> run(const BuildCommand& command) {
  auto file = read_mesh(command.segmentation.model);
  if (!file) return forward_error(file);
  for (const std::string& note : file->notes)
    fmt::print(stderr, "{}: {}\n", command.segmentation.model.string(), note);

  // Ctrl-C ends the work between stages; nothing has been written then.
  const StopOnInterrupt interrupt;
  const std::string name = command.name.empty() ? command.segmentation.model.stem().string() : command.name;
  auto parts = command.segmentation.load_parts(*file);
  if (!parts) return forward_error(parts);
  const IngestOptions options{name,
                              command.units,
                              command.metadata,
                              command.bits,
                              std::move(*parts),
                              command.segmentation.segment,
                              command.lossless,
                              level_goals(command.levels, command.level_ratios, command.level_errors)};
  ProgressLine line;
  auto model =
      ingest(file->soup, options, threaded_for(command.threads), [&](const std::string& stage, double done) {
        line.show(done > 0 ? fmt::format("{} {:.0f} %", stage, 100 * done) : stage);
        return !interrupt.token().stop_requested();
      });
  line.wipe();
  if (!model) return forward_error(model, command.segmentation.model.string());

  const std::filesystem::path path = output_path(command);
  const std::string_view bytes(reinterpret_cast<const char*>(model->pack.data()), model->pack.size());
  if (auto ok = replace_file(path, bytes); !ok) return forward_error(ok, path.string());
  print_repair(model->repair, command.segmentation.model.string());
  auto pack = Pack::open(path);
  if (!pack) return forward_error(pack);
  if (command.json) {
    print_json(command, path, *model, **pack);
  } else {
    print_summary(path, *model, **pack);
  }
  return {};
}

}  // namespace selvage
