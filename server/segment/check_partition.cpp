// SPDX-License-Identifier: MIT
#include "server/segment/check_partition.h"

#include <string>

#include "server/segment/one_ring.h"
#include "server/segment/pieces.h"

namespace selvage {
namespace {

tl::unexpected<Error> violated(const std::string& what, std::uint32_t where) {
  return fail(ErrorCode::BadStream, "partition: " + what + " " + std::to_string(where));
}

Result<void> check_shape(const CornerTable& mesh, const Partition& partition) {
  const auto& begin = partition.region_triangles_begin;
  if (partition.region_of_vertex.size() != mesh.vertex_count()) {
    return violated("labels do not match the vertices:", mesh.vertex_count());
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (partition.region_of_vertex[v] > partition.region_count)
      return violated("region out of range at vertex", v);
  }
  if (begin.size() != std::size_t{partition.region_count} + 2 || begin[0] != 0 || begin[1] != 0 ||
      begin.back() != partition.region_triangles.size()) {
    return violated("region ranges do not match the triangles:", partition.region_count);
  }
  for (RegionId r = 1; r <= partition.region_count; ++r) {
    if (begin[r] >= begin[r + 1]) return violated("no triangle in region", r);
  }
  if (partition.region_triangles.size() + partition.boundary_triangles.size() != mesh.triangle_count()) {
    return violated("triangles missing or listed twice, of", mesh.triangle_count());
  }
  return {};
}

/// G4. With the counts right (check_shape), ascending lists without a stranger hold every triangle once.
Result<void> check_lists(const CornerTable& mesh, const Partition& partition) {
  const auto is_listed_right = [&](std::span<const TriangleId> list, RegionId expected) -> Result<void> {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const TriangleId t = list[i];
      if (t >= mesh.triangle_count()) return violated("no such triangle:", t);
      if (i > 0 && list[i - 1] >= t) return violated("not ascending at triangle", t);
      const bool interior = is_interior(mesh, partition.region_of_vertex, t, kLooseRegion);
      const RegionId actual = interior ? partition.region_of_vertex[mesh.vertex(3 * t)] : kLooseRegion;
      if (actual != expected) return violated("listed in the wrong place: triangle", t);
    }
    return {};
  };
  for (RegionId r = 1; r <= partition.region_count; ++r) {
    if (auto ok = is_listed_right(partition.triangles_of(r), r); !ok) return ok;
  }
  return is_listed_right(partition.boundary_triangles, kLooseRegion);
}

/// G1, G5 and the vertex half of G2; G3 follows.
Result<void> check_fans(const CornerTable& mesh, const Partition& partition) {
  const auto has = [&](CornerId c) {
    return c != kNone && is_interior(mesh, partition.region_of_vertex, triangle_of(c), kLooseRegion);
  };
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (partition.region_of_vertex[v] == kLooseRegion) continue;
    std::uint32_t corners = 0, starts = 0;
    for_each_corner_at(mesh, v, [&](CornerId c) {
      corners += has(c);
      starts += has(c) && !has(mesh.swing_cw(c));
    });
    if (corners == 0) return violated("no interior triangle, but not loose: vertex", v);
    if (starts > 1) return violated("more than one fan of interior triangles at vertex", v);
  }
  return {};
}

/// The other half of G2: a region of several pieces may have no border but the mesh's own.
Result<void> check_pieces(const CornerTable& mesh, const Partition& partition) {
  const Pieces pieces = find_pieces(mesh, partition.region_of_vertex, kLooseRegion);
  std::vector<std::uint32_t> pieces_of_region(partition.region_count + 1, 0);
  for (std::uint32_t p = 0; p < pieces.count(); ++p) ++pieces_of_region[pieces.label[p]];
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const std::uint32_t piece = pieces.of_triangle[triangle_of(c)];
    if (piece == kNone || pieces_of_region[pieces.label[piece]] == 1 || mesh.opposite[c] == kNone) continue;
    if (pieces.of_triangle[triangle_of(mesh.opposite[c])] != piece) {
      return violated("several pieces, not all of them whole components, in region", pieces.label[piece]);
    }
  }
  return {};
}

}  // namespace

Result<void> check_partition(const CornerTable& mesh, const Partition& partition) {
  for (const auto check : {check_shape, check_lists, check_fans, check_pieces}) {
    if (auto ok = check(mesh, partition); !ok) return ok;
  }
  return {};
}

}  // namespace selvage
