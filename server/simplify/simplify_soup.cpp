// SPDX-License-Identifier: MIT
#include "server/simplify/simplify_soup.h"

#include <utility>

#include "server/ingest/spatial_order.h"
#include "server/simplify/levels.h"

namespace selvage {
namespace {

std::vector<VertexId> copies_of_split_vertices(const RepairedMesh& mesh, std::size_t source_count) {
  std::vector<std::uint8_t> copies(source_count, 0);
  for (const VertexId source : mesh.source_of_vertex) copies[source] = copies[source] == 0 ? 1 : 2;
  std::vector<VertexId> split;
  for (VertexId v = 0; v < mesh.source_of_vertex.size(); ++v) {
    if (copies[mesh.source_of_vertex[v]] > 1) split.push_back(v);
  }
  return split;
}

/// The triangles in the file's vertices, direction and order.
std::vector<Triangle> in_file_terms(const RepairedMesh& mesh,
                                    std::span<const VertexId> representative_of_vertex,
                                    std::size_t source_count) {
  constexpr Triangle kNoTriangle = {kNone, kNone, kNone};
  std::vector<TriangleId> triangle_of;
  const std::vector<Triangle> left =
      substituted_triangles(mesh.table, representative_of_vertex, &triangle_of);
  std::vector<Triangle> by_source(source_count, kNoTriangle);
  for (std::size_t i = 0; i < left.size(); ++i) {
    Triangle triangle = left[i];
    for (VertexId& v : triangle) v = mesh.source_of_vertex[v];
    if (mesh.is_turned[triangle_of[i]]) std::swap(triangle[1], triangle[2]);
    const auto [a, b, c] = triangle;
    if (a != b && b != c && c != a) by_source[mesh.source_of_triangle[triangle_of[i]]] = triangle;
  }
  std::erase(by_source, kNoTriangle);
  return by_source;
}

TriangleSoup without_unreferenced(std::span<const Vec3> positions, std::vector<Triangle> triangles) {
  std::vector<VertexId> new_vertex(positions.size(), kNone);
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) new_vertex[v] = 0;
  }
  TriangleSoup soup;
  for (VertexId v = 0; v < positions.size(); ++v) {
    if (new_vertex[v] == kNone) continue;
    new_vertex[v] = static_cast<VertexId>(soup.positions.size());
    soup.positions.push_back(positions[v]);
  }
  for (Triangle& t : triangles) {
    for (VertexId& v : t) v = new_vertex[v];
  }
  soup.triangles = std::move(triangles);
  return soup;
}

}  // namespace

Result<SimplifiedSoup> simplify_soup(const TriangleSoup& soup, const LevelTarget& target,
                                     const SimplifyOptions& options, const SimplifyProgress& progress) {
  auto repaired = repair(soup);
  if (!repaired) return forward_error(repaired);
  const RepairedMesh mesh = spatially_ordered(std::move(*repaired));
  const std::vector<VertexId> pinned = copies_of_split_vertices(mesh, soup.positions.size());
  bool is_stopped = false;
  const Simplification simplification =
      simplify({mesh.table, mesh.positions, {}, pinned}, {&target, 1}, options, [&](double done) {
        is_stopped = is_stopped || (progress && !progress(done));
        return !is_stopped;
      });
  if (is_stopped) return fail(ErrorCode::Cancelled, "cancelled");

  const auto count = static_cast<std::uint32_t>(simplification.collapses.size());
  const auto representative =
      representatives_after(simplification.collapses, count, mesh.table.vertex_count());
  SimplifiedSoup result{.repair = mesh.report,
                        .input_triangles = mesh.table.triangle_count(),
                        .pinned_vertices = static_cast<std::uint32_t>(pinned.size()),
                        .deviation = simplification.levels.back().deviation};
  result.soup =
      without_unreferenced(soup.positions, in_file_terms(mesh, representative, soup.triangles.size()));
  return result;
}

}  // namespace selvage
