// SPDX-License-Identifier: MIT
#include "server/ingest/ingest.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/mesh/grid.h"
#include "common/pack/directory_limits.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/ingest/segment_model.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/partition.h"
#include "server/simplify/model_levels.h"

namespace selvage {
namespace {

/// The directory's entries for a coarse level are the rest of a quarter.
constexpr double kMostBytesOfTwo = 0.24;
/// Fewer triangles take more bytes each.
constexpr double kSpareBytes = 0.9;
constexpr int kMostPasses = 4;

/// Announces stages, takes their times and remembers a wish to cancel.
class StageClock {
 public:
  StageClock(const Progress& progress, std::vector<StageTime>& times) : progress_(progress), times_(times) {}

  /// Runs one stage, or once more one that ran before; gives what it returns.
  template <class Stage>
  auto run(const std::string& name, Stage stage) {
    report(name, 0);
    const auto begin = std::chrono::steady_clock::now();
    auto result = stage();
    add(name, std::chrono::steady_clock::now() - begin);
    return result;
  }

  void report(const std::string& name, double done) {
    const std::scoped_lock lock(mutex_);
    if (!is_cancelled_) is_cancelled_ = !progress_(name, done);
  }

  bool is_cancelled() const { return is_cancelled_; }

 private:
  void add(const std::string& name, std::chrono::duration<double> time) {
    const auto known = std::ranges::find(times_, name, &StageTime::stage);
    if (known == times_.end()) {
      times_.push_back({name, time});
    } else {
      known->seconds += time;
    }
  }

  const Progress& progress_;
  std::vector<StageTime>& times_;
  std::mutex mutex_;
  std::atomic<bool> is_cancelled_ = false;
};

SourceCounts count_source(const TriangleSoup& soup, const RepairReport& report) {
  SourceCounts counts;
  counts.vertices = static_cast<std::uint32_t>(soup.positions.size());
  counts.triangles = static_cast<std::uint32_t>(soup.triangles.size());
  counts.dropped_triangles = report.dropped_triangles;
  counts.unreferenced_vertices = report.unreferenced_vertices;
  counts.flipped_triangles = report.turned_triangles;
  return counts;
}

std::vector<NamedRegions> to_ranges(const std::map<std::string, std::vector<RegionId>>& regions_of_name) {
  std::vector<NamedRegions> names;
  for (const auto& [name, regions] : regions_of_name) {
    names.push_back({name, {}});
    for (RegionId region : regions) {
      auto& ranges = names.back().ranges;
      if (!ranges.empty() && ranges.back().last + 1 == region) {
        ranges.back().last = region;
      } else {
        ranges.push_back({region, region});
      }
    }
  }
  return names;
}

Result<void> check_goals(const std::vector<LevelGoal>& goals) {
  if (goals.size() >= kMaxLevels) {
    return fail(ErrorCode::InvalidArgument, "more than " + std::to_string(kMaxLevels) + " levels of detail");
  }
  LevelGoal finer{.ratio = 1, .error = 0};
  for (const LevelGoal& goal : goals) {
    const bool is_coarser = goal.ratio >= 0 && goal.ratio < 1 && goal.ratio <= finer.ratio &&
                            goal.error >= finer.error &&
                            (goal.ratio < finer.ratio || goal.error > finer.error);
    if (!is_coarser) {
      return fail(ErrorCode::InvalidArgument,
                  "levels of detail must each be coarser than the one before: ratios below 1 that fall, or "
                  "errors that rise");
    }
    finer = goal;
  }
  return {};
}

LevelledMesh make_levels(const RepairedMesh& mesh, const Partition& partition, const Grid& grid,
                         const std::vector<LevelGoal>& goals, const ParallelFor& parallel,
                         const SimplifyProgress& progress) {
  if (goals.empty()) return {};
  std::vector<GridPoint> positions;
  positions.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) positions.push_back(grid.quantise(p));
  std::vector<VertexId> pinned;
  const std::vector<std::uint32_t> weld_groups = find_weld_groups(mesh.table, mesh.source_of_vertex);
  for (VertexId v = 0; v < weld_groups.size(); ++v) {
    if (weld_groups[v] != kNone) pinned.push_back(v);
  }
  std::vector<LevelTarget> targets;
  for (const LevelGoal& goal : goals) {
    targets.push_back({.triangles = static_cast<std::uint32_t>(goal.ratio * mesh.table.triangle_count()),
                       .max_deviation = goal.error / grid.step});
  }
  return make_model_levels({.mesh = mesh.table,
                            .positions = positions,
                            .region_of_vertex = partition.region_of_vertex,
                            .region_count = partition.region_count,
                            .pinned = pinned},
                           targets, parallel, progress);
}

/// Bytes of each level's own parts; of the finest, with joins.
std::vector<double> bytes_by_level(const EncodedModel& model) {
  std::vector<double> bytes(kMaxLevels, 0);
  auto part = model.parts.begin();
  for (const RegionEntry& region : model.directory.regions) {
    for (std::size_t level = region.levels.size(); level-- > 0;) {
      if (!region.levels[level].is_repeat) bytes[level] += static_cast<double>((part++)->size());
    }
    if (region.bundle_triangles > 0) bytes[0] += static_cast<double>((part++)->size());
  }
  return bytes;
}

/// Asks for fewer triangles where a level took more bytes than it may. False if none did, or none has fewer
/// to give: what keeps its collapses from the number asked for is not that number.
bool lower_ratios(const EncodedModel& model, std::uint32_t triangle_count, std::vector<LevelGoal>& goals) {
  const std::vector<double> bytes = bytes_by_level(model);
  bool is_lower = false;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const double most = goals[i].most_bytes * bytes[0];
    double triangles = 0;
    for (const RegionEntry& region : model.directory.regions)
      triangles += i + 1 < region.levels.size() ? region.levels[i + 1].triangles : 0;
    if (bytes[i + 1] <= most || triangles > goals[i].ratio * triangle_count) continue;
    goals[i].ratio *= kSpareBytes * most / bytes[i + 1];
    is_lower = true;
  }
  return is_lower;
}

/// What readers of the directory refuse.
Result<void> check_text(const std::string& what, const std::string& text) {
  if (text.size() <= kMaxDirectoryText) return {};
  return fail(ErrorCode::InvalidArgument, what + " \"" + text.substr(0, 40) + "...\" has " +
                                              std::to_string(text.size()) + " bytes, more than " +
                                              std::to_string(kMaxDirectoryText));
}

Result<void> check_texts(const IngestOptions& options) {
  if (auto ok = check_text("the name", options.name); !ok) return ok;
  if (auto ok = check_text("the units", options.units); !ok) return ok;
  for (const auto& [key, value] : options.metadata) {
    if (auto ok = check_text("the metadata key", key); !ok) return ok;
    if (auto ok = check_text("the metadata value", value); !ok) return ok;
  }
  return {};
}

Result<void> check_regions(const NamedSegmentation& named) {
  for (const auto& [name, regions] : named.regions_of_name) {
    if (auto ok = check_text("the part's name", name); !ok) return ok;
  }
  if (named.regions.region_count < kMaxRegions) return {};
  return fail(ErrorCode::LimitExceeded,
              std::to_string(named.regions.region_count) + " regions are more than clients take, " +
                  std::to_string(kMaxRegions - 1) + "; ask for fewer or larger ones");
}

bool are_floats(const std::vector<Vec3>& positions) {
  return std::all_of(positions.begin(), positions.end(), [](const Vec3& p) {
    constexpr double kMost = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) > kMost || static_cast<double>(static_cast<float>(p[axis])) != p[axis])
        return false;
    }
    return true;
  });
}

}  // namespace

std::vector<LevelGoal> usual_levels(unsigned count) {
  const double step = count == 2 ? 0.125 : count == 3 ? 0.25 : 0.5;
  std::vector<LevelGoal> goals;
  for (unsigned level = 1; level < count; ++level) goals.push_back({.ratio = std::pow(step, level)});
  if (count == 2) goals.front().most_bytes = kMostBytesOfTwo;
  return goals;
}

std::vector<LevelGoal> level_goals(unsigned count, std::span<const double> ratios,
                                   std::span<const double> errors) {
  std::vector<LevelGoal> goals;
  for (const double ratio : ratios) goals.push_back({.ratio = ratio});
  for (const double error : errors) goals.push_back({.error = error});
  return goals.empty() ? usual_levels(count) : goals;
}

Result<IngestedModel> ingest(const TriangleSoup& soup, const IngestOptions& options,
                             const ParallelFor& parallel, const Progress& progress) {
  if (options.bits < kMinGridBits || options.bits > kMaxGridBits) {
    return fail(ErrorCode::InvalidArgument, "grid bits must be " + std::to_string(kMinGridBits) + " to " +
                                                std::to_string(kMaxGridBits) + ", not " +
                                                std::to_string(options.bits));
  }
  if (auto ok = check_goals(options.levels); !ok) return forward_error(ok);
  if (auto ok = check_texts(options); !ok) return forward_error(ok);
  IngestedModel model;
  StageClock clock(progress, model.times);
  const auto cancelled = [] { return fail(ErrorCode::Cancelled, "cancelled"); };

  auto repaired = clock.run("repair", [&] { return repair(soup); });
  if (!repaired) return forward_error(repaired);
  if (options.lossless && !are_floats(repaired->positions)) {
    return fail(ErrorCode::InvalidArgument,
                "a coordinate has more digits than a float32 holds, so it cannot be kept bit for bit");
  }
  model.repair = repaired->report;
  if (!options.parts.of_triangle.empty()) {
    *repaired =
        clock.run("cut", [&] { return cut_along_parts(std::move(*repaired), options.parts.of_triangle); });
  }
  const RepairedMesh mesh = clock.run("order", [&] { return spatially_ordered(std::move(*repaired)); });
  if (clock.is_cancelled()) return cancelled();
  const SegmentOptions sized = with_streaming_sizes(options.segment, mesh.table.triangle_count());
  NamedSegmentation named =
      clock.run("segment", [&] { return segment_model(mesh, options.parts, sized, parallel); });
  const Segmentation& segmentation = named.regions;
  if (clock.is_cancelled()) return cancelled();
  if (auto ok = check_regions(named); !ok) return forward_error(ok);
  const Partition partition = clock.run("partition", [&] {
    return make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  });
  const Grid grid = make_grid(mesh.positions, options.bits);
  const ModelSource source{.table = mesh.table,
                           .positions = mesh.positions,
                           .source_of_vertex = mesh.source_of_vertex,
                           .is_turned = mesh.is_turned,
                           .partition = partition,
                           .is_exact = options.lossless};
  ModelEncoder encoder(source, grid, {});
  // Once, but for levels that then turn out to take too many bytes.
  std::vector<LevelGoal> goals = options.levels;
  Result<EncodedModel> encoded;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const LevelledMesh levels = clock.run("simplify", [&] {
      return make_levels(mesh, partition, grid, goals, parallel, [&](double done) {
        clock.report("simplify", done);
        return !clock.is_cancelled();
      });
    });
    if (clock.is_cancelled()) return cancelled();
    const double parts = (2.0 + static_cast<double>(goals.size())) * (partition.region_count + 1);
    std::atomic<std::uint32_t> done = 0;
    encoded = clock.run("encode", [&] {
      return encoder.encode(goals.empty() ? nullptr : &levels, parallel,
                            [&] { clock.report("encode", ++done / parts); });
    });
    if (clock.is_cancelled()) return cancelled();
    if (!encoded) return forward_error(encoded);
    if (!lower_ratios(*encoded, mesh.table.triangle_count(), goals)) break;
  }

  Directory& directory = encoded->directory;
  directory.name = options.name;
  directory.units = options.units;
  directory.metadata = options.metadata;
  directory.source = count_source(soup, mesh.report);
  directory.vertices = directory.source.vertices - directory.source.unreferenced_vertices;
  directory.triangles = mesh.table.triangle_count();
  directory.source.cut_vertices = static_cast<std::uint32_t>(mesh.positions.size()) - directory.vertices;
  directory.names = to_ranges(named.regions_of_name);
  model.names = static_cast<std::uint32_t>(directory.names.size());
  model.pack = clock.run("assemble", [&] { return assemble_pack(std::move(directory), encoded->parts); });
  model.regions = partition.region_count;
  model.loose_vertices = static_cast<std::uint32_t>(
      std::count(partition.region_of_vertex.begin(), partition.region_of_vertex.end(), kLooseRegion));
  return model;
}

}  // namespace selvage
