// SPDX-License-Identifier: MIT
//
// What does each stage of segmentation cost, over building the adjacency in the same process?
//
//   stage_bench MODEL...                     default mode, one core, triangles in Morton order
//   stage_bench --threads 2 MODEL...
//   stage_bench --mode streaming --set tau=0.02 MODEL...
//   stage_bench --mode classic-3 --repeats 7 MODEL...
//
// The last one, over classic-1, -2, -3 and -5, is the dissertation's Fig. 4.15, and Fig. 4.16 by its lines
// "by size" and "by depth". Times are the least of the repeats, in ms: CPU time, or wall time with more than
// one thread. Then come regions, boundary triangles and loose vertices. A plain way of building the adjacency
// comes first, to judge that unit by.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "bench/segment/modes.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/check_partition.h"
#include "server/segment/components.h"
#include "server/segment/erosion.h"
#include "server/segment/merge_by_depth.h"
#include "server/segment/merge_by_size.h"
#include "server/segment/minima.h"
#include "server/segment/vertex_measures.h"

namespace selvage::bench {
namespace {

struct Command {
  std::string mode = "xmrg";
  std::vector<std::string> settings, models;
  unsigned threads = 1;
  int repeats = 3;
};

/// Least time of each named step over the repeats, in the order of the first.
class Stopwatch {
 public:
  explicit Stopwatch(bool use_cpu_time) : use_cpu_time_(use_cpu_time) {}

  template <class Step>
  auto operator()(const char* name, Step&& step) {
    const double start = now_ms();
    auto result = step();
    note(name, now_ms() - start);
    return result;
  }
  void print(double reference_ms) const {
    for (const auto& [name, ms] : steps_)
      std::printf("  %-12s %9.2f ms  %6.1f x\n", name.c_str(), ms, ms / reference_ms);
  }
  double least(const char* name) const {
    for (const auto& [known, ms] : steps_)
      if (known == name) return ms;
    return 0;
  }

 private:
  double now_ms() const {
    if (use_cpu_time_) return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  void note(const char* name, double ms) {
    for (auto& [known, least] : steps_) {
      if (known == name) {
        least = std::min(least, ms);
        return;
      }
    }
    steps_.emplace_back(name, ms);
  }
  bool use_cpu_time_;
  std::vector<std::pair<std::string, double>> steps_;
};

std::vector<Triangle> triangles_of(const CornerTable& mesh) {
  std::vector<Triangle> triangles;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) triangles.push_back(mesh.triangle(t));
  return triangles;
}

/// Opposite corners as anyone would find them first: sort the sides of triangles by edge, pair equal ones.
/// What the time of building the adjacency, the unit of all others, is to be judged by.
std::vector<CornerId> opposites_by_sorting(const std::vector<Triangle>& triangles) {
  struct Side {
    std::uint64_t edge;
    CornerId corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [u, v] : {std::pair{b, c}, std::pair{c, a}, std::pair{a, b}}) {
      sides.push_back(
          {std::uint64_t{std::min(u, v)} << 32 | std::max(u, v), static_cast<CornerId>(sides.size())});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) { return x.edge < y.edge; });
  std::vector<CornerId> opposite(sides.size(), kNone);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].edge != sides[i - 1].edge) continue;
    opposite[sides[i].corner] = sides[i - 1].corner;
    opposite[sides[i - 1].corner] = sides[i].corner;
  }
  return opposite;
}

/// The stages of xmrg one by one, as xmrg.cpp and regularise() run them.
void time_stages(const CornerTable& mesh, const std::vector<Vec3>& positions, const XmrgOptions& options,
                 const ParallelFor& parallel, Stopwatch& time) {
  const auto neighbours = time("neighbours", [&] { return Neighbours(mesh); });
  const auto components = time("components", [&] { return find_components(mesh); });
  const auto shapes = time("shapes", [&] { return measure_components(mesh, positions, components); });
  const auto measures = time("measures", [&] { return measure_vertices(mesh, positions); });
  const auto field = time("height", [&] {
    return measure_height(mesh, neighbours, positions, components, shapes, measures, options.height,
                          parallel);
  });
  auto basins = time("basins", [&] { return flood_basins(neighbours, positions, field, options.basins); });
  time("hierarchy", [&] {
    return build_hierarchy(mesh, positions, components, shapes, measures, field.kappa, basins,
                           options.hierarchy);
  });
}

/// The stages of classic mode, and depth-based merging to the same number of regions beside its own
/// (Fig. 4.16).
void time_stages(const CornerTable& mesh, const std::vector<Vec3>& positions, const ClassicOptions& options,
                 const ParallelFor& parallel, Stopwatch& time) {
  const Components components = find_components(mesh);
  const auto shapes = measure_components(mesh, positions, components);
  const Features features = time("features", [&] {
    return extract_features(mesh, positions, components, shapes, options.xmr_rings, parallel);
  });
  const Neighbours neighbours(mesh);
  Minima basins =
      time("minima", [&] { return label_minima(neighbours, find_plateau(features, options.thresholds)); });
  basins = time("erosion", [&] {
    erode_plateau(neighbours, basins);
    return basins;
  });
  const std::uint32_t regions = time("by size", [&] {
    std::vector<std::uint32_t> labels = basins.label_of_vertex;
    return merge_by_size(mesh, labels, basins.count, default_merge_threshold(mesh.vertex_count()));
  });
  time("by depth", [&] {
    Minima merged = basins;
    std::vector<double> height = features.distance;
    for (double& h : height) h = -h;
    merge_by_depth(mesh, height, merged, regions);
    return merged;
  });
  std::printf("%u basins merged to %u regions; ", basins.count, regions);
}

int bench_model(const Command& command, const Mode& mode, const std::string& path) {
  auto file = read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().to_string().c_str()), 1;
  auto repaired = repair(file->soup);
  if (!repaired)
    return std::fprintf(stderr, "%s: %s\n", path.c_str(), repaired.error().to_string().c_str()), 1;
  const RepairedMesh ordered = spatially_ordered(std::move(*repaired));
  const CornerTable& mesh = ordered.table;
  const std::vector<Vec3>& positions = ordered.positions;
  const SegmentOptions options = mode.for_triangles(mesh.triangle_count());
  const ParallelFor parallel = command.threads == 1 ? serial_for() : threaded_for(command.threads);
  const bool is_xmrg = options.mode == SegmentMode::Xmrg || options.mode == SegmentMode::Cad;

  Stopwatch time(command.threads == 1);
  Segmentation result;
  const std::vector<Triangle> triangles = triangles_of(mesh);
  for (int i = 0; i < command.repeats; ++i) {
    time("plain sort", [&] { return opposites_by_sorting(triangles); });
    time("adjacency", [&] { return build_corner_table(triangles, mesh.vertex_count()); });
    if (is_xmrg)
      time_stages(mesh, positions, xmrg_options(options), parallel, time);
    else
      time_stages(mesh, positions, ClassicOptions{options.xmr_rings, options.thresholds}, parallel, time);
    result = time("segment", [&] { return segment(mesh, positions, options, parallel); });
    time("regularise",
         [&] { return regularise(mesh, result.region_of_vertex, options.regularise, positions); });
  }
  const auto partition = make_partition(mesh, result.region_of_vertex, result.region_count);
  const auto holds = check_partition(mesh, partition);
  std::printf("%s: %u triangles, %u regions, boundary triangles %.2f %%, loose vertices %u%s%s\n",
              path.c_str(), mesh.triangle_count(), result.region_count,
              100.0 * static_cast<double>(partition.boundary_triangles.size()) / mesh.triangle_count(),
              result.loose_vertex_count, holds ? "" : ", VIOLATION ",
              holds ? "" : holds.error().message.c_str());
  time.print(time.least("adjacency"));
  return holds ? 0 : 1;
}

int run(int argc, char** argv) {
  Command command;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool has_value = i + 1 < argc;
    if (argument == "--mode" && has_value)
      command.mode = argv[++i];
    else if (argument == "--set" && has_value)
      command.settings.push_back(argv[++i]);
    else if (argument == "--threads" && has_value)
      command.threads = static_cast<unsigned>(std::stoul(argv[++i]));
    else if (argument == "--repeats" && has_value)
      command.repeats = std::stoi(argv[++i]);
    else
      command.models.push_back(argument);
  }
  std::vector<Mode> modes = chosen_modes(command.mode);
  if (modes.size() != 1 || command.models.empty() || !apply_settings(modes, command.settings)) {
    std::fprintf(
        stderr, "usage: stage_bench [--mode M] [--threads N] [--repeats N] [--set name=value]... MODEL...\n");
    return 2;
  }
  int failed = 0;
  for (const std::string& model : command.models) failed += bench_model(command, modes.front(), model);
  return failed > 0;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) { return selvage::bench::run(argc, argv); }
