// SPDX-License-Identifier: MIT
//
// The dissertation's tables and pictures of segmentation, beside ours.
//
//   dissertation_bench MODELS OUT
//
// MODELS is a folder with hand.ply, bunny.ply, tommygun.ply and teapot.ply (those that are missing are left
// out); the watering can is generated. Prints Table 4.5 with times and Table 4.6 with the times it quotes,
// and draws Fig. 4.11 to 4.13 as OUT/fig_4_11.png ...
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh_io/read_mesh.h"
#include "common/render/palette.h"
#include "common/render/png.h"
#include "common/render/sheet.h"
#include "common/samples/waterneck.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/segment.h"
#include "server/segment/triangle_labels.h"

namespace selvage::bench {
namespace {

struct Model {
  std::string name;
  int rings;  ///< of Table 4.5
  std::string published_faces;
  RepairedMesh mesh;
};

struct Timed {
  Segmentation segmentation;
  double seconds;
};

SegmentOptions classic(int rings) { return {.mode = SegmentMode::Classic, .xmr_rings = rings}; }

Timed timed(const RepairedMesh& mesh, const SegmentOptions& options) {
  Timed best{{}, 1e30};
  for (int repeat = 0; repeat < 3; ++repeat) {
    const std::clock_t begin = std::clock();
    best.segmentation = segment(mesh.table, mesh.positions, options, serial_for());
    best.seconds = std::min(best.seconds, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

std::optional<RepairedMesh> load(const std::filesystem::path& path) {
  auto file = read_mesh(path);
  if (!file) return std::nullopt;
  auto repaired = repair(file->soup);
  if (!repaired) return std::nullopt;
  return spatially_ordered(std::move(*repaired));
}

std::vector<Model> load_models(const std::filesystem::path& folder) {
  std::vector<Model> models;
  models.push_back({"waterneck", 3, "117,564", spatially_ordered(*repair(make_waterneck(117564)))});
  const auto add = [&](const char* name, int rings, const char* faces) {
    if (auto mesh = load(folder / (std::string(name) + ".ply")))
      models.push_back({name, rings, faces, std::move(*mesh)});
  };
  add("hand", 5, "76,438");
  add("bunny", 2, "69,451");
  add("tommygun", 1, "8,210");
  add("teapot", 1, "2,256");
  return models;
}

void print_tables(const std::vector<Model>& models) {
  std::printf("Table 4.5, CPU time of one core\n%-12s %10s %10s %4s %12s %8s %12s %8s\n", "model",
              "N_f there", "N_f here", "L", "classic s", "regions", "xmrg s", "regions");
  for (const Model& model : models) {
    const Timed old = timed(model.mesh, classic(model.rings)), ours = timed(model.mesh, {});
    std::printf("%-12s %10s %10u %4d %12.4f %8u %12.4f %8u\n", model.name.c_str(),
                model.published_faces.c_str(), model.mesh.table.triangle_count(), model.rings, old.seconds,
                old.segmentation.region_count, ours.seconds, ours.segmentation.region_count);
  }
  for (const Model& model : models) {
    if (model.name != "bunny") continue;
    std::printf("\nTable 4.6, bunny; all but the last two as published, on machines of 1999 to 2003\n");
    std::printf("%-36s %s\n", "dissertation, XMR level 2", "18 s");
    std::printf("%-36s %s\n", "Levy et al. 2002", "30 s");
    std::printf("%-36s %s\n", "E. Zhang et al. 2003 (Venus, 67k)", "67 s");
    std::printf("%-36s %s\n", "Katz and Tal 2003", "244 s");
    std::printf("%-36s %s\n", "Sander et al. 2003", "at most 300 s");
    std::printf("%-36s %.4f s\n", "classic here, XMR level 2", timed(model.mesh, classic(2)).seconds);
    std::printf("%-36s %.4f s\n", "xmrg here", timed(model.mesh, {}).seconds);
  }
}

Panel draw(const Model& model, SegmentOptions options, const std::string& caption) {
  const Segmentation segmentation = segment(model.mesh.table, model.mesh.positions, options, serial_for());
  std::vector<Triangle> triangles;
  for (TriangleId t = 0; t < model.mesh.table.triangle_count(); ++t)
    triangles.push_back(model.mesh.table.triangle(t));
  const auto colour_of_region = colours_of_regions(
      segmentation.region_count + 1, neighbouring_regions(triangles, segmentation.region_of_vertex));
  std::vector<Rgb> colours;
  for (RegionId region : regions_of_triangles(model.mesh.table, segmentation))
    colours.push_back(colour_of_region[region]);
  const Camera camera = fit_camera(model.mesh.positions, {}, 560, 480);
  return {render({model.mesh.positions, triangles, colours, {}}, camera, {.border_px = 1.2}),
          model.name + ", " + caption + ", " + std::to_string(segmentation.region_count) + " regions"};
}

SegmentOptions unmerged(SegmentOptions options) {
  options.min_region_vertices = 1;
  return options;
}

int draw_figures(const std::vector<Model>& models, const std::filesystem::path& folder) {
  std::vector<Panel> low, high, rings;
  for (const Model& model : models) {
    const bool is_low = model.mesh.table.triangle_count() < 20000;
    const int best = is_low ? 1 : model.rings;
    (is_low ? low : high).push_back(draw(model, {.mode = SegmentMode::Zhang, .xmr_rings = best}, "Zhang"));
    (is_low ? low : high).push_back(draw(model, classic(best), "classic"));
    if (model.name != "bunny") continue;
    for (int count : {1, 2, 3}) {
      const std::string level = "L = " + std::to_string(count);
      rings.push_back(draw(model, unmerged(classic(count)), level + " unmerged"));
      rings.push_back(draw(model, classic(count), level + " merged"));
    }
  }
  const auto write = [&](const char* file, const char* title, const std::vector<Panel>& panels) {
    if (panels.empty()) return true;
    return write_png(folder / file, make_sheet(panels, {.columns = 2, .title = title})).has_value();
  };
  const bool is_written =
      write("fig_4_11.png", "Curvature alone against classic mode, low resolution", low) &&
      write("fig_4_12.png", "Curvature alone against classic mode, high resolution", high) &&
      write("fig_4_13.png", "Neighbourhoods of one, two and three rings, before and after merging", rings);
  return is_written ? 0 : 1;
}

int run(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: dissertation_bench MODELS OUT\n"), 2;
  const std::vector<Model> models = load_models(argv[1]);
  print_tables(models);
  return draw_figures(models, argv[2]);
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) { return selvage::bench::run(argc, argv); }
