// SPDX-License-Identifier: MIT
#include "tests/support/levelled_model.h"

#include <algorithm>
#include <map>
#include <set>

#include "common/base/parallel.h"
#include "common/mesh/boundary_loops.h"
#include "common/mesh/grid.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/segment/regularise.h"

namespace selvage {
namespace {

/// By vertex: the number of its weld group, kNone for vertices that are no copies.
std::vector<std::uint32_t> weld_groups(const std::vector<VertexId>& source_of_vertex) {
  std::map<VertexId, std::uint32_t> copies;
  for (const VertexId source : source_of_vertex) ++copies[source];
  std::vector<std::uint32_t> groups;
  for (const VertexId source : source_of_vertex) groups.push_back(copies[source] > 1 ? source : kNone);
  return groups;
}

std::vector<VertexId> members_of(const std::vector<std::uint32_t>& group_of_vertex) {
  std::vector<VertexId> members;
  for (VertexId v = 0; v < group_of_vertex.size(); ++v) {
    if (group_of_vertex[v] != kNone) members.push_back(v);
  }
  return members;
}

/// The region's triangles at a level, in the mesh's vertices.
std::vector<Triangle> triangles_of(const LevelledModel& model, RegionId id, std::uint32_t level) {
  std::vector<Triangle> triangles;
  for (const TriangleId t : model.levels.regions[level][id].triangles) {
    triangles.push_back(model.mesh.table.triangle(t));
    for (VertexId& v : triangles.back()) v = model.levels.representative_of_vertex[level][v];
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> in_canonical_order(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

RegionMesh LevelledModel::region(RegionId id, std::uint32_t level) const {
  RegionMesh region;
  const std::vector<VertexId>& vertices = levels.regions[level][id].vertices;
  std::map<VertexId, VertexId> local;
  for (const VertexId v : vertices) local.emplace(v, static_cast<VertexId>(local.size()));
  region.triangles = triangles_of(*this, id, level);
  for (Triangle& triangle : region.triangles) {
    for (VertexId& v : triangle) v = local.at(v);
  }
  for (const VertexId v : vertices) {
    region.positions.push_back({static_cast<std::int32_t>(mesh.source_of_vertex[v]), 0, 0});
    if (group_of_vertex_[v] != kNone) region.anchors.push_back({local.at(v), group_of_vertex_[v]});
  }
  for (const TriangleId t : levels.regions[level][id].triangles)
    region.is_turned.push_back(mesh.is_turned[t]);
  region.loops =
      find_boundary_loops(build_corner_table(region.triangles, static_cast<std::uint32_t>(vertices.size())));
  for (const VertexId v : boundary_of_region_[id])
    region.vertex_of_boundary.push_back(local.at(levels.representative_of_vertex[level][v]));
  if (id == kLooseRegion) region.loops = {region.vertex_of_boundary, directory.regions[id].loop_lengths};
  return region;
}

std::vector<Triangle> LevelledModel::mix(std::span<const std::uint32_t> level_of_region) const {
  std::vector<Triangle> mixed;
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) {
    Triangle triangle = mesh.table.triangle(t);
    bool is_there = true;
    for (VertexId& v : triangle) {
      const std::uint32_t level = level_of_region[partition.region_of_vertex[v]];
      is_there = is_there && level != kAbsent;
      if (is_there) v = mesh.source_of_vertex[levels.representative_of_vertex[level][v]];
    }
    const auto [a, b, c] = triangle;
    if (!is_there || a == b || b == c || c == a) continue;
    if (mesh.is_turned[t]) std::swap(triangle[1], triangle[2]);
    mixed.push_back(triangle);
  }
  return in_canonical_order(std::move(mixed));
}

LevelledModel levelled_model(std::string name, RepairedMesh mesh,
                             std::span<const std::uint32_t> label_of_vertex, std::span<const double> ratios) {
  LevelledModel model;
  model.name = std::move(name);
  model.mesh = std::move(mesh);
  const CornerTable& table = model.mesh.table;
  const Segmentation segmentation =
      regularise(table, label_of_vertex, {.min_piece_triangles = 3}, model.mesh.positions);
  model.partition = make_partition(table, segmentation.region_of_vertex, segmentation.region_count);
  std::vector<LevelTarget> targets;
  for (const double ratio : ratios)
    targets.push_back({static_cast<std::uint32_t>(ratio * table.triangle_count())});
  model.group_of_vertex_ = weld_groups(model.mesh.source_of_vertex);
  const auto pinned = members_of(model.group_of_vertex_);
  const auto& labels = model.partition.region_of_vertex;
  model.levels = split_by_region(table, labels, model.partition.region_count,
                                 simplify({table, model.mesh.positions, labels, pinned}, targets));

  const std::uint32_t regions = model.partition.region_count + 1;
  model.directory.regions.resize(regions);
  model.boundary_of_region_.resize(regions);
  model.bundles.resize(regions);
  std::map<VertexId, std::uint32_t> boundary_index;
  for (RegionId id = 0; id < regions; ++id) {
    RegionEntry& entry = model.directory.regions[id];
    std::vector<VertexId>& boundary = model.boundary_of_region_[id];
    if (id == kLooseRegion) {
      boundary = model.levels.regions[0][id].vertices;
      if (!boundary.empty()) entry.loop_lengths = {static_cast<std::uint32_t>(boundary.size())};
    } else {
      const BoundaryLoops loops =
          find_boundary_loops(build_corner_table(triangles_of(model, id, 0), table.vertex_count()));
      boundary = loops.vertices;
      entry.loop_lengths = loops.lengths;
    }
    for (std::uint32_t i = 0; i < boundary.size(); ++i) boundary_index[boundary[i]] = i;
  }
  for (const TriangleId t : model.partition.boundary_triangles) {
    BoundaryTriangle triangle;
    RegionId highest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = table.triangle(t)[k];
      triangle.corners[k] = {labels[v], boundary_index.at(v)};
      highest = std::max(highest, labels[v]);
    }
    triangle.is_turned = model.mesh.is_turned[t];
    model.bundles[highest].push_back(triangle);
  }
  return model;
}

Bytes levelled_pack(const LevelledModel& model, int bits) {
  const RepairedMesh& mesh = model.mesh;
  ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, model.partition};
  source.levels = &model.levels;
  EncodedModel encoded = encode_model(source, make_grid(mesh.positions, bits), serial_for(), [] {}).value();
  encoded.directory.name = model.name;
  encoded.directory.vertices =
      static_cast<std::uint32_t>(std::set(mesh.source_of_vertex.begin(), mesh.source_of_vertex.end()).size());
  encoded.directory.triangles = mesh.table.triangle_count();
  return assemble_pack(std::move(encoded.directory), encoded.parts);
}

}  // namespace selvage
