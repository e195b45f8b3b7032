// SPDX-License-Identifier: MIT
#include "tests/support/labelled_pack.h"

#include <cmath>

#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/ingest/repair.h"
#include "server/segment/partition.h"
#include "server/segment/regularise.h"
#include "server/simplify/model_levels.h"

namespace selvage {

namespace {

LevelledMesh levels_of(const RepairedMesh& mesh, const Partition& partition, const Grid& grid,
                       std::span<const double> ratios) {
  if (ratios.empty()) return {};
  std::vector<GridPoint> positions;
  for (const Vec3& p : mesh.positions) positions.push_back(grid.quantise(p));
  std::vector<VertexId> pinned;
  const auto weld_groups = find_weld_groups(mesh.table, mesh.source_of_vertex);
  for (VertexId v = 0; v < weld_groups.size(); ++v) {
    if (weld_groups[v] != kNone) pinned.push_back(v);
  }
  std::vector<LevelTarget> targets;
  for (double ratio : ratios)
    targets.push_back({.triangles = static_cast<std::uint32_t>(ratio * mesh.table.triangle_count())});
  return make_model_levels(
      {mesh.table, positions, partition.region_of_vertex, partition.region_count, pinned}, targets,
      serial_for());
}

}  // namespace

Bytes labelled_pack(const TriangleSoup& soup, std::span<const std::uint32_t> label_of_vertex, int bits,
                    bool is_exact, std::span<const double> level_ratios) {
  const RepairedMesh mesh = repair(soup).value();
  std::vector<std::uint32_t> labels;
  for (VertexId source : mesh.source_of_vertex) labels.push_back(label_of_vertex[source]);
  const Segmentation segmentation = regularise(mesh.table, labels, {}, mesh.positions);
  const Partition partition =
      make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  const Grid grid = make_grid(mesh.positions, bits);
  const LevelledMesh levels = levels_of(mesh, partition, grid, level_ratios);
  const ModelSource source{mesh.table,
                           mesh.positions,
                           mesh.source_of_vertex,
                           mesh.is_turned,
                           partition,
                           is_exact,
                           level_ratios.empty() ? nullptr : &levels};
  EncodedModel model = encode_model(source, grid, serial_for(), [] {}).value();
  model.directory.name = "labelled";
  model.directory.vertices =
      static_cast<std::uint32_t>(soup.positions.size()) - mesh.report.unreferenced_vertices;
  model.directory.triangles = mesh.table.triangle_count();
  return assemble_pack(std::move(model.directory), model.parts);
}

std::vector<std::uint32_t> cube_labels(const TriangleSoup& soup, double cell) {
  std::vector<std::uint32_t> labels;
  const auto place = [&](double at) {
    return static_cast<std::uint32_t>(std::floor(at / cell) + 512) & 1023;
  };
  for (const Vec3& p : soup.positions) labels.push_back(place(p.x) << 20 | place(p.y) << 10 | place(p.z));
  return labels;
}

}  // namespace selvage
