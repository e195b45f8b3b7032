// SPDX-License-Identifier: MIT
#include "client/app/compare_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/app/model_source.h"
#include "common/mesh/same_mesh.h"
#include "common/mesh_io/read_mesh.h"

namespace selvage {
namespace {

struct Input {
  TriangleSoup soup;
  std::optional<Grid> grid;  ///< of a pack
};

Result<Input> read_input(const std::filesystem::path& path) {
  if (path.extension() != ".selvage") {
    auto file = read_mesh(path);
    if (!file) return forward_error(file);
    return Input{std::move(file->soup), std::nullopt};
  }
  auto model = load_model(path.string());
  if (!model) return forward_error(model);
  return Input{std::move(model->fetched.mesh.soup), model->directory.grid};
}

void print_json(const MeshComparison& comparison, double tolerance, double step) {
  const nlohmann::ordered_json json = {
      {"same", comparison.same},
      {"undecided", comparison.undecided},
      {"largest_difference", comparison.largest_difference},
      {"largest_difference_grid_steps", comparison.largest_difference / step},
      {"tolerance", tolerance},
      {"grid_step", step},
      {"difference", comparison.difference},
      {"vertices", {comparison.vertices_a, comparison.vertices_b}},
      {"triangles", {comparison.triangles_a, comparison.triangles_b}},
      {"repeated_index_triangles", {comparison.repeated_index_a, comparison.repeated_index_b}}};
  fmt::print("{}\n", json.dump(2));
}

void print_text(const MeshComparison& comparison, double tolerance, double step) {
  if (comparison.repeated_index_a + comparison.repeated_index_b > 0) {
    fmt::print("left out: triangles that repeat a vertex, {} and {}\n", comparison.repeated_index_a,
               comparison.repeated_index_b);
  }
  if (comparison.same) {
    fmt::print(
        "same: {} vertices, {} oriented triangles; largest difference {:.6g} model units, {:.4f} grid "
        "steps\n",
        comparison.vertices_a, comparison.triangles_a, comparison.largest_difference,
        comparison.largest_difference / step);
  } else {
    fmt::print("{}: {} (tolerance {:.6g})\n", comparison.undecided ? "undecided" : "different",
               comparison.difference, tolerance);
  }
}

}  // namespace

Result<bool> run(const CompareCommand& command) {
  auto a = read_input(command.a);
  if (!a) return forward_error(a);
  auto b = read_input(command.b);
  if (!b) return forward_error(b);
  const Grid grid = b->grid ? *b->grid : a->grid ? *a->grid : make_grid(a->soup.positions, command.bits);
  const double tolerance = command.tolerance.value_or(grid.step / 2);
  const MeshComparison comparison = compare_meshes(a->soup, b->soup, tolerance);
  if (command.json) {
    print_json(comparison, tolerance, grid.step);
  } else {
    print_text(comparison, tolerance, grid.step);
  }
  return comparison.same;
}

}  // namespace selvage
