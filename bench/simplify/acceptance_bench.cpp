// SPDX-License-Identifier: MIT
//
// Is simplification, and are levels of detail, as good as they are meant to be? All figures in one run, ours
// beside the bar that was set for it.
//
//   acceptance_bench MODELS            a folder with seeds/bunny.ply, seeds/horse.ply ... cad/fandisk.off
//   acceptance_bench MODELS --quick    without distances of mixes and the largest model
//
// Simplifiers are compared at a tenth of the triangles: geometric means over the models that are there, of
// bunny, horse, igea, armadillo, hand, cow, fandisk, rockerarm and lucy. Levels are measured model by model,
// in 60 regions; packs in 40, on grids of 12 and 14 bits, and as they come by default. CPU times are ratios
// within the run. The exit code says whether all bars are met.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/simplify/figures.h"
#include "bench/simplify/labelled_levels.h"
#include "bench/simplify/metro.h"
#include "bench/simplify/peers.h"
#include "common/mesh_io/read_mesh.h"
#include "common/pack/pack.h"
#include "server/ingest/ingest.h"

namespace selvage::bench {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kModels = {"seeds/bunny.ply",     "seeds/horse.ply",     "seeds/igea.ply",
                                          "seeds/armadillo.ply", "seeds/hand.ply",      "seeds/cow.obj",
                                          "cad/fandisk.off",     "scans/rockerarm.ply", "scans/lucy100k.ply"};
const std::vector<std::string> kLevelModels = {"seeds/bunny.ply", "seeds/horse.ply", "seeds/igea.ply",
                                               "seeds/hand.ply"};

/// Prints a line a claim, and remembers whether all were met.
class Table {
 public:
  void claim(const std::string& what, double ours, double bar) {
    const bool is_met = ours <= bar;
    std::printf("%-74s %9.4g %9.4g  %s\n", what.c_str(), ours, bar, is_met ? "met" : "MISSED");
    std::fflush(stdout);
    missed_ += !is_met;
  }
  int missed() const { return missed_; }

 private:
  int missed_ = 0;
};

void compare_simplifiers(const std::vector<fs::path>& models, Table& table) {
  std::map<std::string, Ratios> over;
  for (const fs::path& path : models) {
    BenchMesh mesh;
    if (!load(path.string(), mesh)) continue;
    Figures ours;
    for (const Simplifier& simplifier : all_simplifiers()) {
      const bool is_bar = simplifier.name == "meshopt" || simplifier.name == "openmesh" ||
                          simplifier.name == "cgal" || simplifier.name == "melax";
      if (!is_bar && simplifier.name != "md") continue;
      const Figures figures = measure(simplifier, mesh, 0.1);
      if (simplifier.name == "md") ours = figures;
      over[simplifier.name].add(ours, figures);
    }
  }
  const auto over_peer = [&](const char* name) { return over[name].mean(); };
  const Figures meshopt = over_peer("meshopt"), openmesh = over_peer("openmesh"), melax = over_peer("melax");
  table.claim("Hausdorff distance at 10 %, over meshopt_simplify", meshopt.hausdorff, 0.60);
  table.claim("  over OpenMesh's quadrics with its flipping test", openmesh.hausdorff, 0.50);
  table.claim("  over Melax's PR", melax.hausdorff, 1);
  table.claim("mean distance, over meshopt_simplify", meshopt.mean, 0.80);
  table.claim("  over OpenMesh", openmesh.mean, 0.95);
  table.claim("CPU time, over OpenMesh", openmesh.seconds, 0.25);
  table.claim("  over meshopt_simplify", meshopt.seconds, 10);
  table.claim("memory above the input, over OpenMesh", openmesh.megabytes, 0.60);
  if (!over.contains("cgal")) {
    std::printf("(CGAL's Garland-Heckbert is not built in; see bench/simplify/CMakeLists.txt)\n");
    return;
  }
  const Figures cgal = over_peer("cgal");
  table.claim("Hausdorff distance, over CGAL's Garland-Heckbert", cgal.hausdorff, 0.75);
  table.claim("  mean distance", cgal.mean, 1.20);
  table.claim("  CPU time", cgal.seconds, 0.35);
}

void measure_levels(const fs::path& path, bool is_quick, Table& table) {
  const auto mesh = load_labelled(path.string(), 60);
  if (!mesh) return;
  const std::string name = path.stem().string();
  double labelled_seconds = 0, free_seconds = 0;
  const Simplification labelled = simplified(*mesh, mesh->segmentation.region_of_vertex, labelled_seconds);
  const Simplification free_run = simplified(*mesh, {}, free_seconds);
  const SurfaceDistance with = surface_distance(mesh->finest, level_of(*mesh, labelled, kLevels - 1));
  const SurfaceDistance without = surface_distance(mesh->finest, level_of(*mesh, free_run, kLevels - 1));
  const std::string regions = name + ", " + std::to_string(mesh->segmentation.region_count) + " regions: ";
  table.claim(regions + "Hausdorff distance at 6.25 %, over no regions", with.largest / without.largest,
              1.40);
  table.claim("  mean distance", with.mean / without.mean, 1.40);
  const LevelledMesh levels = split_by_region(mesh->table, mesh->segmentation.region_of_vertex,
                                              mesh->segmentation.region_count, labelled);
  const int measured = is_quick ? 0 : 6;
  const MixFigures smooth =
      measure_mixes(*mesh, levels, {.count = 50, .measured = measured, .is_smooth = true});
  const MixFigures any = measure_mixes(*mesh, levels, {.count = 100, .measured = measured});
  table.claim("  of 150 random mixes, not manifold or of other topology", smooth.broken + any.broken, 0);
  if (!is_quick) {
    table.claim("  Hausdorff distance of mixes, over the coarsest level",
                std::max(smooth.largest_distance, any.largest_distance) / with.largest, 1.05);
  }
  table.claim("  reversed strip triangles, levels of neighbours adjacent, % of area", smooth.most_reversed,
              0.05);
  table.claim("  in any mix", any.most_reversed, 0.5);
}

struct Packed {
  double bytes = 0, seconds = 0, share_of_triangles = 0;
};
Packed pack_of(const TriangleSoup& soup, IngestOptions options) {
  const std::clock_t start = std::clock();
  const auto model = ingest(soup, options, serial_for(), [](const std::string&, double) { return true; });
  Packed packed;
  packed.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (!model) return std::fprintf(stderr, "%s\n", model.error().to_string().c_str()), packed;
  packed.bytes = static_cast<double>(model->pack.size());
  const auto pack = Pack::from_bytes(model->pack).value();
  double finest = 0, coarsest = 0;
  for (const RegionEntry& region : pack->directory().regions) {
    if (region.levels.empty()) continue;
    finest += region.levels.front().triangles;
    coarsest += region.levels.back().triangles;
  }
  packed.share_of_triangles = coarsest / std::max(finest, 1.0);
  return packed;
}

void measure_packs(const std::vector<fs::path>& models, Table& table) {
  for (const int bits : {12, 14}) {
    double two = 0, five = 0;
    for (const fs::path& path : models) {
      const auto file = read_mesh(path);
      if (!file) continue;
      IngestOptions options{.bits = bits};
      options.segment.target_regions = 40;
      options.levels = {};
      const double one = pack_of(file->soup, options).bytes;
      options.levels = {{.ratio = 0.125}};
      two = std::max(two, pack_of(file->soup, options).bytes / one);
      options.levels = usual_levels(5);
      five = std::max(five, pack_of(file->soup, options).bytes / one);
    }
    const std::string grid = std::to_string(bits) + " bits, 40 regions, most of the models: ";
    table.claim(grid + "bytes with 12.5 %, over one level", two, bits == 12 ? 1.30 : 1.22);
    table.claim("  with 50, 25, 12.5 and 6.25 %", five, bits == 12 ? 1.55 : 1.45);
  }
}

void measure_default_packs(const std::vector<fs::path>& models, Table& table) {
  double bytes = 0, share = 0, most_seconds = 0;
  for (const fs::path& path : models) {
    const auto file = read_mesh(path);
    if (!file) continue;
    const Packed two = pack_of(file->soup, {}), one = pack_of(file->soup, {.levels = {}});
    bytes = std::max(bytes, two.bytes / one.bytes);
    share = std::max(share, two.share_of_triangles);
    most_seconds = std::max(most_seconds, two.seconds / one.seconds);
  }
  table.claim("default packs, most of the models: bytes over --levels 1", bytes, 1.25);
  table.claim("  share of the triangles in the coarse level", share, 0.15);
  table.claim("  CPU time to build, over --levels 1", most_seconds, 3);
}

std::vector<fs::path> present(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> paths;
  for (const std::string& name : names) {
    if (fs::exists(folder / name)) paths.push_back(folder / name);
  }
  return paths;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  using namespace selvage::bench;
  const bool is_quick = argc == 3 && std::string(argv[2]) == "--quick";
  if (argc < 2 || (argc > 2 && !is_quick))
    return std::fprintf(stderr, "usage: acceptance_bench MODELS [--quick]\n"), 2;
  const auto models = present(argv[1], kModels), level_models = present(argv[1], kLevelModels);
  if (models.empty()) return std::fprintf(stderr, "%s: none of the models is here\n", argv[1]), 2;
  std::printf("%-74s %9s %9s\n", "", "ours", "bar");
  Table table;
  compare_simplifiers(models, table);
  for (const auto& path : level_models) measure_levels(path, is_quick, table);
  measure_packs(level_models, table);
  measure_default_packs(models, table);
  std::printf("%d missed\n", table.missed());
  return table.missed() == 0 ? 0 : 1;
}
