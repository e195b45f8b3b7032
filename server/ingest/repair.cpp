// SPDX-License-Identifier: MIT
#include "server/ingest/repair.h"

#include <algorithm>
#include <string>
#include <utility>

#include "common/base/disjoint_sets.h"
#include "common/base/gathered.h"
#include "server/ingest/adjacency.h"
#include "server/ingest/orient.h"
#include "server/ingest/split_fans.h"

namespace selvage {
namespace {

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::vector<TriangleId> triangles_without_repeats(const TriangleSoup& soup) {
  std::vector<TriangleId> kept;
  kept.reserve(soup.triangles.size());
  for (TriangleId t = 0; t < soup.triangles.size(); ++t) {
    if (!repeats_a_vertex(soup.triangles[t])) kept.push_back(t);
  }
  return kept;
}

/// Duplicates share all their edges, so it is enough to look at each triangle once, at the edge of its two
/// lower vertices: there, duplicates have the same apex.
std::uint32_t count_duplicates(const EdgeGroups& edges, std::span<const Triangle> triangles) {
  std::uint32_t duplicates = 0;
  std::vector<VertexId> apexes;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    if (edges[edge].size() < 2) continue;
    apexes.clear();
    for (CornerId side : edges[edge]) {
      const Triangle& t = triangles[triangle_of(side)];
      const VertexId apex = t[side % 3];
      if (apex == std::max({t[0], t[1], t[2]})) apexes.push_back(apex);
    }
    std::sort(apexes.begin(), apexes.end());
    duplicates += static_cast<std::uint32_t>(apexes.end() - std::unique(apexes.begin(), apexes.end()));
  }
  return duplicates;
}

std::uint32_t count_zero_area(const std::vector<Triangle>& triangles, const std::vector<Vec3>& positions) {
  std::uint32_t count = 0;
  for (const auto& [a, b, c] : triangles) {
    count += cross(positions[b] - positions[a], positions[c] - positions[a]) == Vec3{};
  }
  return count;
}

/// Swaps the second and third corner of turned triangles, in the vertices and in what the opposites name.
void turn(const std::vector<bool>& is_turned, std::vector<VertexId>& vertex_of_corner,
          std::vector<CornerId>& opposite) {
  for (TriangleId t = 0; t < is_turned.size(); ++t) {
    if (!is_turned[t]) continue;
    std::swap(vertex_of_corner[3 * t + 1], vertex_of_corner[3 * t + 2]);
    std::swap(opposite[3 * t + 1], opposite[3 * t + 2]);
  }
  for (CornerId& across : opposite) {
    if (across == kNone || across % 3 == 0 || !is_turned[triangle_of(across)]) continue;
    across = across % 3 == 1 ? across + 1 : across - 1;
  }
}

std::vector<VertexId> flatten(const std::vector<Triangle>& triangles) {
  std::vector<VertexId> vertex_of_corner;
  vertex_of_corner.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) vertex_of_corner.insert(vertex_of_corner.end(), t.begin(), t.end());
  return vertex_of_corner;
}

std::uint32_t count_components(const CornerTable& table) {
  DisjointSets pieces(table.vertex_count());
  std::uint32_t components = table.vertex_count();
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    components -= pieces.merge(table.vertex(c), table.vertex(next(c)));
  }
  return components;
}

/// What the repaired mesh tells beside what was noted on the way.
void count_outcome(const RepairedMesh& mesh, std::size_t source_count, RepairReport& report) {
  enum : std::uint8_t { Unused, Once, Split };
  std::vector<std::uint8_t> use(source_count, Unused);
  for (VertexId source : mesh.source_of_vertex) use[source] = use[source] == Unused ? Once : Split;
  const auto unused = std::count(use.begin(), use.end(), Unused);
  report.unreferenced_vertices = static_cast<std::uint32_t>(unused);
  report.non_manifold_vertices = static_cast<std::uint32_t>(std::count(use.begin(), use.end(), Split));
  report.vertex_copies = static_cast<std::uint32_t>(mesh.source_of_vertex.size() - (source_count - unused));

  const std::vector<CornerId>& opposite = mesh.table.opposite;
  report.boundary_edges = static_cast<std::uint32_t>(std::count(opposite.begin(), opposite.end(), kNone));
  report.components = count_components(mesh.table);
}

struct Connection {
  std::vector<CornerId> across;
  std::vector<bool> is_turned;
};

/// Decides which triangles are neighbours and which are turned.
Connection connect(const std::vector<Triangle>& triangles, std::size_t vertex_count, RepairReport& report) {
  const EdgeGroups edges = group_edges(triangles, static_cast<std::uint32_t>(vertex_count));
  report.duplicate_triangles = count_duplicates(edges, triangles);
  std::vector<CornerId> across = join_two_sided_edges(edges, 3 * triangles.size());
  Orientation orientation = orient(triangles, across);
  report.turned_triangles = orientation.turned_triangles;
  report.non_orientable_cuts = orientation.cut_edges;
  report.non_manifold_edges = pair_crowded_edges(edges, triangles, orientation.is_turned, across);
  return {std::move(across), std::move(orientation.is_turned)};
}

}  // namespace

Result<RepairedMesh> repair(const TriangleSoup& soup) {
  constexpr std::size_t kMaxTriangles = kNone / 3;
  if (soup.triangles.size() > kMaxTriangles || soup.positions.size() >= kNone) {
    return fail(ErrorCode::LimitExceeded, "more than " + std::to_string(kMaxTriangles) + " triangles");
  }
  RepairedMesh mesh;
  mesh.source_of_triangle = triangles_without_repeats(soup);
  const std::size_t dropped = soup.triangles.size() - mesh.source_of_triangle.size();
  mesh.report.dropped_triangles = static_cast<std::uint32_t>(dropped);
  if (mesh.source_of_triangle.empty()) {
    return fail(ErrorCode::BadFile,
                "no triangle left after dropping " + std::to_string(dropped) + " with repeated indices");
  }
  const std::vector<Triangle> triangles = gathered(soup.triangles, mesh.source_of_triangle);
  mesh.report.zero_area_triangles = count_zero_area(triangles, soup.positions);

  auto [across, is_turned] = connect(triangles, soup.positions.size(), mesh.report);
  std::vector<VertexId> source_of_corner = flatten(triangles);
  turn(is_turned, source_of_corner, across);
  SplitTable split = split_fans(std::move(source_of_corner), std::move(across));

  mesh.table = std::move(split.table);
  mesh.positions = gathered(soup.positions, split.source_of_vertex);
  mesh.source_of_vertex = std::move(split.source_of_vertex);
  mesh.is_turned = std::move(is_turned);
  count_outcome(mesh, soup.positions.size(), mesh.report);
  return mesh;
}

}  // namespace selvage
