// SPDX-License-Identifier: MIT
#include "client/app/draw_command.h"

#include <algorithm>

#include <fmt/format.h>

#include "client/app/level_pictures.h"
#include "client/app/model_source.h"
#include "common/base/progress_line.h"
#include "common/base/stop_on_interrupt.h"
#include "common/render/palette.h"
#include "common/render/png.h"
#include "common/render/sheet.h"

namespace selvage {
namespace {

std::vector<Rgb> region_colours(const LoadedModel& model) {
  const auto neighbours =
      neighbouring_regions(model.fetched.mesh.soup.triangles, model.fetched.mesh.region_of_vertex);
  return colours_of_regions(static_cast<std::uint32_t>(model.directory.regions.size()), neighbours);
}

Scene scene_of(const StitchedMesh& mesh, const RegionPaint& paint) {
  return {mesh.soup.positions, mesh.soup.triangles, paint.colour_of_triangle, paint.region_of_triangle};
}

/// What is there when the regions up to `last` are: all triangles whose corners are.
StitchedMesh up_to_region(const StitchedMesh& mesh, RegionId last) {
  StitchedMesh part{{mesh.soup.positions, {}}, mesh.region_of_vertex};
  const auto is_there = [&](VertexId v) { return mesh.region_of_vertex[v] <= last; };
  std::copy_if(mesh.soup.triangles.begin(), mesh.soup.triangles.end(),
               std::back_inserter(part.soup.triangles),
               [&](const Triangle& t) { return is_there(t[0]) && is_there(t[1]) && is_there(t[2]); });
  return part;
}

std::vector<Panel> draw_sides(const LoadedModel& model, const DrawCommand& command) {
  const RegionPaint paint = paint_regions(model.fetched.mesh.soup.triangles,
                                          model.fetched.mesh.region_of_vertex, region_colours(model));
  const RenderOptions options{.label_px = command.labels ? command.size / 32.0 : 0};
  return render_views(scene_of(model.fetched.mesh, paint), four_sides(command.up), command.size,
                      command.size * 3 / 4, options);
}

std::vector<Panel> draw_arrival(const LoadedModel& model, const DrawCommand& command) {
  const std::vector<Rgb> colours = region_colours(model);
  const Camera camera =
      fit_camera(model.fetched.mesh.soup.positions, {.up = command.up}, command.size, command.size * 3 / 4);
  const std::uint32_t regions = model.directory.real_region_count();
  const auto steps = std::min(static_cast<std::uint32_t>(command.steps), regions);
  std::vector<Panel> panels;
  for (std::uint32_t step = 1; step <= steps; ++step) {
    const RegionId last = static_cast<RegionId>(std::uint64_t{regions} * step / steps);
    const StitchedMesh part = up_to_region(model.fetched.mesh, last);
    const RegionPaint paint = paint_regions(part.soup.triangles, part.region_of_vertex, colours);
    panels.push_back(
        {render(scene_of(part, paint), camera),
         fmt::format("{} of {} regions, {} triangles", last, regions, part.soup.triangles.size())});
  }
  return panels;
}

std::vector<Panel> draw_regions(const LoadedModel& model, const DrawCommand& command) {
  return command.steps > 0 ? draw_arrival(model, command) : draw_sides(model, command);
}

Result<void> write_sheet(const DrawCommand& command, const std::vector<Panel>& panels, std::string title) {
  const Image sheet = make_sheet(panels, {.title = std::move(title)});
  if (auto ok = write_png(command.output, sheet); !ok) return ok;
  fmt::print("{}: {} x {} pixels\n", command.output.string(), sheet.width, sheet.height);
  return {};
}

Result<void> run_levels(const DrawCommand& command) {
  const StopOnInterrupt interrupt;
  auto model = open_model(command.source, command.options, interrupt.token());
  if (!model) return forward_error(model);
  const auto load = [&](const Selection& selection) -> Result<StitchedMesh> {
    auto loaded = load_selection(*model, selection, interrupt.token());
    if (!loaded) return forward_error(loaded);
    return std::move(loaded->fetched.mesh);
  };
  const Directory& directory = model->directory();
  auto panels = draw_levels(directory, load, command.up, command.size);
  if (!panels) return forward_error(panels);
  return write_sheet(command, *panels,
                     fmt::format("{}: {} regions, {} triangles", directory.name,
                                 directory.real_region_count(), directory.triangles));
}

}  // namespace

Result<void> run(const DrawCommand& command) {
  if (command.levels) return run_levels(command);
  const StopOnInterrupt interrupt;
  auto model = load_model(command.source, command.selection, command.options, interrupt.token());
  if (!model) return forward_error(model);
  ProgressLine line;
  line.show("drawing");
  const std::vector<Panel> panels = draw_regions(*model, command);
  line.wipe();
  return write_sheet(command, panels,
                     fmt::format("{}: {} regions, {} triangles", model->directory.name,
                                 model->fetched.regions, model->fetched.mesh.soup.triangles.size()));
}

}  // namespace selvage
