// SPDX-License-Identifier: MIT
#include "server/app/segment_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/base/replace_file.h"
#include "common/mesh_io/read_mesh.h"
#include "common/render/palette.h"
#include "common/render/png.h"
#include "common/render/sheet.h"
#include "server/app/coloured_ply.h"
#include "server/ingest/segment_model.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/partition.h"

namespace selvage {
namespace {

struct SegmentedFile {
  TriangleSoup soup;
  RepairedMesh mesh;
  NamedSegmentation named;
  std::vector<RegionId> region_of_triangle;  ///< by the file's triangle
  std::size_t boundary_triangles = 0;
};

SegmentOptions options_for(const SegmentCommand& command, const RepairedMesh& mesh) {
  const SegmentOptions& options = command.segmentation.segment;
  return command.streaming ? with_streaming_sizes(options, mesh.table.triangle_count()) : options;
}

Result<SegmentedFile> segment_file(const SegmentCommand& command) {
  const std::string path = command.segmentation.model.string();
  auto file = read_mesh(path);
  if (!file) return forward_error(file);
  for (const std::string& note : file->notes) fmt::print(stderr, "{}: {}\n", path, note);
  auto parts = command.segmentation.load_parts(*file);
  if (!parts) return forward_error(parts);
  auto repaired = repair(file->soup);
  if (!repaired) return forward_error(repaired, path);
  if (!parts->of_triangle.empty()) *repaired = cut_along_parts(std::move(*repaired), parts->of_triangle);

  SegmentedFile result{.soup = std::move(file->soup), .mesh = spatially_ordered(std::move(*repaired))};
  result.named =
      segment_model(result.mesh, *parts, options_for(command, result.mesh), threaded_for(command.threads));
  const Segmentation& regions = result.named.regions;
  result.region_of_triangle = regions_of_source_triangles(result.mesh, regions, result.soup.triangles.size());
  const Partition partition =
      make_partition(result.mesh.table, regions.region_of_vertex, regions.region_count);
  result.boundary_triangles = partition.boundary_triangles.size();
  return result;
}

/// Colours in which regions that meet at a vertex of the file differ.
std::vector<Rgb> region_colours(const SegmentedFile& model) {
  std::vector<RegionId> region_of_vertex(model.soup.positions.size(), kNone);
  std::vector<RegionPair> neighbours;
  for (TriangleId t = 0; t < model.soup.triangles.size(); ++t) {
    const RegionId region = model.region_of_triangle[t];
    for (VertexId v : model.soup.triangles[t]) {
      RegionId& other = region_of_vertex[v];
      if (other == kNone) other = region;
      if (other != region) neighbours.push_back(std::minmax(other, region));
    }
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return colours_of_regions(model.named.regions.region_count + 1, neighbours);
}

nlohmann::ordered_json counts_json(const SegmentedFile& model) {
  return {{"triangles", model.soup.triangles.size()},
          {"regions", model.named.regions.region_count},
          {"boundary_triangles", model.boundary_triangles},
          {"loose_vertices", model.named.regions.loose_vertex_count},
          {"regions_of_name", model.named.regions_of_name}};
}

SegmentFormat format_of(const SegmentCommand& command) {
  if (command.format) return *command.format;
  if (command.output.extension() == ".ply") return SegmentFormat::Ply;
  return command.output.extension() == ".json" ? SegmentFormat::Json : SegmentFormat::Seg;
}

std::string content_of(const SegmentCommand& command, const SegmentedFile& model) {
  switch (format_of(command)) {
    case SegmentFormat::Ply:
      return coloured_ply(model.soup, model.region_of_triangle, region_colours(model));
    case SegmentFormat::Json: {
      nlohmann::ordered_json json = counts_json(model);
      json["region_of_triangle"] = model.region_of_triangle;
      return json.dump() + "\n";
    }
    case SegmentFormat::Seg:
      break;
  }
  std::string lines;
  for (RegionId region : model.region_of_triangle) fmt::format_to(std::back_inserter(lines), "{}\n", region);
  return lines;
}

Result<void> draw(const SegmentCommand& command, const SegmentedFile& model) {
  const std::vector<Rgb> colour_of_region = region_colours(model);
  std::vector<Rgb> colours;
  for (RegionId region : model.region_of_triangle) colours.push_back(colour_of_region[region]);
  const Scene scene{model.soup.positions, model.soup.triangles, colours, {}};
  const auto panels = render_views(scene, four_sides(command.up), command.size, command.size * 3 / 4,
                                   {.border_px = std::max(1.0, command.size / 400.0)});
  const Image sheet = make_sheet(
      panels, {.title = fmt::format("{}: {} regions", command.segmentation.model.filename().string(),
                                    model.named.regions.region_count)});
  return write_png(command.png, sheet);
}

RegionHierarchy hierarchy_of(const SegmentCommand& command, const RepairedMesh& mesh) {
  return grow_xmrg_hierarchy(mesh.table, Neighbours(mesh.table), mesh.positions,
                             xmrg_options(options_for(command, mesh)), threaded_for(command.threads))
      .regions;
}

nlohmann::ordered_json hierarchy_json(const RegionHierarchy& hierarchy) {
  nlohmann::ordered_json merges = nlohmann::ordered_json::array();
  for (const RegionMerge& merge : hierarchy.merges) merges.push_back({merge.a, merge.b, merge.saliency});
  return {{"basins", hierarchy.basin_count}, {"merges", std::move(merges)}};
}

void print_hierarchy(const RegionHierarchy& hierarchy, double stop) {
  const std::size_t first_kept = hierarchy.merges_below(stop);
  fmt::print("{} basins; each line: regions left, saliency, the two that become one\n",
             hierarchy.basin_count);
  for (std::size_t i = 0; i < hierarchy.merges.size(); ++i) {
    const RegionMerge& merge = hierarchy.merges[i];
    if (i == first_kept) fmt::print("  -- the default stops here, at saliency {} --\n", stop);
    fmt::print("{:>6} {:>10.6f}  {} <- {}\n", hierarchy.basin_count - i - 1, merge.saliency, merge.a,
               merge.b);
  }
}

void print_names(const std::map<std::string, std::vector<RegionId>>& regions_of_name) {
  constexpr std::size_t kShown = 50;
  std::size_t shown = 0;
  for (const auto& [name, regions] : regions_of_name) {
    if (shown++ == kShown) {
      fmt::print("  and {} more names; --json lists them\n", regions_of_name.size() - kShown);
      return;
    }
    fmt::print("  {}: {}\n", name, fmt::join(regions, ","));
  }
}

Result<void> check(const SegmentCommand& command) {
  const SegmentMode mode = command.segmentation.segment.mode;
  if (command.output.empty() && command.png.empty() && !command.hierarchy) {
    return fail(ErrorCode::InvalidArgument, "nothing to write: give -o, --png or --hierarchy");
  }
  if (command.hierarchy &&
      (command.segmentation.by[0] != "shape" || (mode != SegmentMode::Xmrg && mode != SegmentMode::Cad))) {
    return fail(ErrorCode::InvalidArgument, "only --mode xmrg and cad have a --hierarchy");
  }
  return {};
}

}  // namespace

Result<void> run(const SegmentCommand& command) {
  if (auto ok = check(command); !ok) return ok;
  auto model = segment_file(command);
  if (!model) return forward_error(model);
  if (!command.output.empty()) {
    if (auto ok = replace_file(command.output, content_of(command, *model)); !ok)
      return forward_error(ok, command.output.string());
  }
  if (!command.png.empty()) {
    if (auto ok = draw(command, *model); !ok) return ok;
  }
  if (command.json) {
    nlohmann::ordered_json json = counts_json(*model);
    if (command.hierarchy) json["hierarchy"] = hierarchy_json(hierarchy_of(command, model->mesh));
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  const Segmentation& regions = model->named.regions;
  fmt::print("{}: {} regions, {} triangles, {} of them between regions, {} loose vertices\n",
             command.segmentation.model.string(), regions.region_count, model->soup.triangles.size(),
             model->boundary_triangles, regions.loose_vertex_count);
  print_names(model->named.regions_of_name);
  if (command.hierarchy)
    print_hierarchy(hierarchy_of(command, model->mesh), options_for(command, model->mesh).stop_saliency);
  return {};
}

}  // namespace selvage
