// SPDX-License-Identifier: MIT
#include "server/simplify/levels.h"

#include <algorithm>

namespace selvage {
namespace {

/// The triangle with its corners replaced; repeats a vertex if it is gone.
Triangle substituted(const CornerTable& mesh, TriangleId t,
                     std::span<const VertexId> representative_of_vertex) {
  Triangle triangle = mesh.triangle(t);
  for (VertexId& v : triangle) v = representative_of_vertex[v];
  return triangle;
}

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::vector<RegionLevel> regions_at(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                                    std::uint32_t region_count,
                                    std::span<const VertexId> representative_of_vertex) {
  std::vector<RegionLevel> regions(region_count + 1);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    const RegionId region = region_of_vertex[a];
    const bool is_interior =
        region != kLooseRegion && region_of_vertex[b] == region && region_of_vertex[c] == region;
    if (is_interior && !repeats_a_vertex(substituted(mesh, t, representative_of_vertex))) {
      regions[region].triangles.push_back(t);
    }
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (representative_of_vertex[v] == v) regions[region_of_vertex[v]].vertices.push_back(v);
  }
  return regions;
}

}  // namespace

CornerId corner_across(const CornerTable& mesh, std::span<const VertexId> representative_of_vertex,
                       CornerId c) {
  const auto at = [&](CornerId corner) { return representative_of_vertex[mesh.vertex(corner)]; };
  CornerId across = mesh.opposite[c];
  // A triangle that is gone has its third vertex in one of the edge's two; the way out is to the other.
  while (across != kNone) {
    if (at(across) == at(next(across))) {
      across = mesh.opposite[next(across)];
    } else if (at(across) == at(prev(across))) {
      across = mesh.opposite[prev(across)];
    } else {
      break;
    }
  }
  return across;
}

std::vector<Triangle> substituted_triangles(const CornerTable& mesh,
                                            std::span<const VertexId> representative_of_vertex,
                                            std::vector<TriangleId>* source_of_triangle) {
  std::vector<Triangle> triangles;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle triangle = substituted(mesh, t, representative_of_vertex);
    if (repeats_a_vertex(triangle)) continue;
    triangles.push_back(triangle);
    if (source_of_triangle != nullptr) source_of_triangle->push_back(t);
  }
  return triangles;
}

LevelledMesh split_by_region(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                             std::uint32_t region_count, const Simplification& simplification) {
  LevelledMesh levels;
  std::vector<double> deviation_of_region(region_count + 1, 0);
  std::uint32_t done = 0;
  for (const SimplifiedLevel& level : simplification.levels) {
    std::vector<bool> has_changed(region_count + 1, false);
    for (; done < level.collapses; ++done) {
      const Collapse& collapse = simplification.collapses[done];
      const RegionId region = region_of_vertex[collapse.from];
      has_changed[region] = true;
      deviation_of_region[region] = std::max(deviation_of_region[region], collapse.deviation);
    }
    levels.representative_of_vertex.push_back(
        representatives_after(simplification.collapses, level.collapses, mesh.vertex_count()));
    auto regions = regions_at(mesh, region_of_vertex, region_count, levels.representative_of_vertex.back());
    for (RegionId region = 0; region <= region_count; ++region) {
      regions[region].deviation = deviation_of_region[region];
      regions[region].is_repeat = !levels.regions.empty() && !has_changed[region];
    }
    levels.regions.push_back(std::move(regions));
  }
  return levels;
}

std::vector<Triangle> mixed_triangles(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                                      const LevelledMesh& levels,
                                      std::span<const std::uint32_t> level_of_region) {
  std::vector<VertexId> representative(mesh.vertex_count());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    representative[v] = levels.representative_of_vertex[level_of_region[region_of_vertex[v]]][v];
  }
  return substituted_triangles(mesh, representative);
}

}  // namespace selvage
