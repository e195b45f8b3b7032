// SPDX-License-Identifier: MIT
#include "common/codec/region_mesh.h"

#include <algorithm>
#include <string>

#include "common/base/disjoint_sets.h"
#include "common/mesh/edge_groups.h"

namespace selvage {
namespace {

tl::unexpected<Error> violated(const std::string& what, std::size_t where) {
  return fail(ErrorCode::BadStream, "region mesh: " + what + " " + std::to_string(where));
}

Result<void> check_sizes(const RegionMesh& mesh) {
  const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
  if (!mesh.exact.empty() && mesh.exact.size() != vertices)
    return violated("exact positions:", mesh.exact.size());
  if (!mesh.is_turned.empty() && mesh.is_turned.size() != triangles)
    return violated("turned triangles:", mesh.is_turned.size());
  for (const Anchor& anchor : mesh.anchors) {
    if (anchor.vertex >= vertices) return violated("no such vertex of an anchor:", anchor.vertex);
  }
  for (const VertexId v : mesh.vertex_of_boundary) {
    if (v >= vertices) return violated("no such vertex for a boundary index:", v);
  }
  for (TriangleId t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (std::max({a, b, c}) >= vertices) return violated("vertex out of range in triangle", t);
    if (a == b || b == c || c == a) return violated("repeated vertex in triangle", t);
  }
  return {};
}

/// By vertex, the next one on its loop; kNone for those on none. Checks that loops are in canonical order and
/// share no vertex.
Result<std::vector<VertexId>> next_on_loops(const RegionMesh& mesh) {
  std::vector<VertexId> next(mesh.vertex_count(), kNone);
  std::span<const VertexId> rest(mesh.loops.vertices);
  VertexId start_before = kNone;
  for (const std::uint32_t length : mesh.loops.lengths) {
    if (length == 0 || length > rest.size()) return violated("impossible length of a loop:", length);
    const auto loop = rest.first(length);
    rest = rest.subspan(length);
    for (std::size_t i = 0; i < length; ++i) {
      if (loop[i] >= next.size()) return violated("vertex out of range on a loop:", loop[i]);
      if (next[loop[i]] != kNone) return violated("twice on loops: vertex", loop[i]);
      next[loop[i]] = loop[i + 1 < length ? i + 1 : 0];
    }
    const bool is_behind = start_before == kNone || start_before < loop[0];
    if (!is_behind || *std::min_element(loop.begin(), loop.end()) != loop[0])
      return violated("not where it belongs: the loop of vertex", loop[0]);
    start_before = loop[0];
  }
  if (!rest.empty()) return violated("vertices beyond the last loop:", rest.size());
  return next;
}

/// With every edge walked as often one way as the other, loops walking along the outside, the triangles of a
/// fan can be walked around in one turn exactly if each shares an edge with another of them.
Result<void> check_surface(const RegionMesh& mesh, std::span<const VertexId> next_on_loop) {
  const auto vertex = [&](CornerId c) { return mesh.triangles[triangle_of(c)][c % 3]; };
  const EdgeGroups edges = group_edges(mesh.triangles, mesh.vertex_count());
  const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  DisjointSets fans(corners);
  std::size_t fan_count = corners;
  std::size_t loop_edges = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges[e];
    const VertexId a = vertex(next(sides[0])), b = vertex(prev(sides[0]));
    int balance = 0;
    for (const CornerId side : sides) {
      const bool is_along = vertex(next(side)) == a;
      balance += is_along ? 1 : -1;
      fan_count -= fans.merge(is_along ? next(side) : prev(side), next(sides[0]));
      fan_count -= fans.merge(is_along ? prev(side) : next(side), prev(sides[0]));
    }
    const int along = next_on_loop[a] == b, against = next_on_loop[b] == a;
    if (balance != along - against) return violated("not walked both ways: an edge of vertex", a);
    loop_edges += static_cast<std::size_t>(along + against);
  }
  if (loop_edges != mesh.loops.vertices.size()) return violated("loops along no edge:", loop_edges);
  std::vector<bool> is_used(mesh.vertex_count());
  for (const Triangle& triangle : mesh.triangles) {
    for (const VertexId v : triangle) is_used[v] = true;
  }
  const auto unused = std::find(is_used.begin(), is_used.end(), false);
  if (unused != is_used.end())
    return violated("no triangle at vertex", static_cast<std::size_t>(unused - is_used.begin()));
  if (fan_count != mesh.vertex_count()) return violated("more fans than vertices:", fan_count);
  return {};
}

}  // namespace

Result<void> check_region_mesh(const RegionMesh& mesh) {
  if (auto ok = check_sizes(mesh); !ok) return ok;
  auto next_on_loop = next_on_loops(mesh);
  if (!next_on_loop) return forward_error(next_on_loop);
  if (!mesh.triangles.empty()) return check_surface(mesh, *next_on_loop);
  // Loose vertices.
  if (mesh.loops.vertices.size() != mesh.positions.size())
    return violated("loose vertices on no loop:", mesh.positions.size() - mesh.loops.vertices.size());
  return {};
}

}  // namespace selvage
