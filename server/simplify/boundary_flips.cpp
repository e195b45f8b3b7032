// SPDX-License-Identifier: MIT
#include "server/simplify/boundary_flips.h"

#include <array>
#include <numeric>

namespace selvage {
namespace {

constexpr double kLeastCosine = 0.2;
/// Of a triangle that lies folded over, in mean triangles of the finest mesh. Without a limit 2.8 % of the
/// area of a mix of fandisk's levels is reversed, with it 0.4; with two the coarse levels get worse again.
constexpr double kLargestFold = 4;

Vec3 normal_of(const std::array<Vec3, 3>& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

}  // namespace

BoundaryFlips::BoundaryFlips(const CornerTable& mesh, std::span<const Vec3> positions,
                             std::span<const RegionId> region_of_vertex, double mean_area)
    : mesh_(mesh), positions_(positions), region_of_vertex_(region_of_vertex), mean_area_(mean_area) {
  if (region_of_vertex.empty()) return;
  next_on_way_.resize(mesh.vertex_count());
  std::iota(next_on_way_.begin(), next_on_way_.end(), 0u);
  triangles_ = GatheredLists<TriangleId>(mesh.vertex_count());
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    if (region_of_vertex[a] == region_of_vertex[b] && region_of_vertex[a] == region_of_vertex[c]) continue;
    for (const VertexId v : {a, b, c}) triangles_.add(v, t);
  }
}

VertexId BoundaryFlips::current(VertexId v) {
  while (next_on_way_[v] != v) v = next_on_way_[v] = next_on_way_[next_on_way_[v]];
  return v;
}

bool BoundaryFlips::keeps_normal(TriangleId t, VertexId u, VertexId v, const Neighbour& neighbour) {
  const auto& representative_of_vertex = neighbour.representative_of_vertex;
  const RegionId own = region_of_vertex_[u];
  std::array<Vec3, 3> before, after;
  std::array<VertexId, 3> ids;
  bool has_target = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId corner = mesh_.triangle(t)[k];
    if (region_of_vertex_[corner] == own) {
      ids[k] = current(corner);
    } else {
      ids[k] = representative_of_vertex.empty() ? corner : representative_of_vertex[corner];
    }
    has_target = has_target || ids[k] == v;
    before[k] = positions_[ids[k]];
    after[k] = ids[k] == u ? positions_[v] : before[k];
  }
  const bool is_gone = ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0];
  if (is_gone || has_target) return true;  // before or after the collapse
  const Vec3 n = normal_of(before), m = normal_of(after);
  const double n_length = length(n), m_length = length(m);
  if (n_length == 0 || dot(m, n) > kLeastCosine * m_length * n_length) return true;
  return !neighbour.is_near && m_length <= kLargestFold * 2 * mean_area_ &&
         dot(m, n) < -kLeastCosine * m_length * n_length;
}

bool BoundaryFlips::keep_normals(VertexId u, VertexId v, std::span<const std::vector<VertexId>> published) {
  return triangles_.all_of(u, [&](TriangleId t) {
    if (!keeps_normal(t, u, v, {{}, published.empty()})) return false;
    for (const auto& level : published) {
      if (!keeps_normal(t, u, v, {level, &level == &published.back()})) return false;
    }
    return true;
  });
}

void BoundaryFlips::collapse(VertexId u, VertexId v) {
  if (triangles_.is_empty()) return;
  next_on_way_[u] = v;
  triangles_.collapse(u, v);
}

}  // namespace selvage
