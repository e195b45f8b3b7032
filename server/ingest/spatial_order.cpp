// SPDX-License-Identifier: MIT
#include "server/ingest/spatial_order.h"

#include <algorithm>
#include <utility>

#include "common/base/gathered.h"

namespace selvage {
namespace {

constexpr int kBitsPerAxis = 21;  // three of them fill a 64-bit key

struct Box {
  Vec3 low, high;
};

Box box_of(const std::vector<Vec3>& points) {
  Box box{points[0], points[0]};
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

/// Moves bit i of a 21-bit number to bit 3 i.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFF;
  x = (x | x << 16) & 0x001F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

/// A cell number, safe where extents overflow or underflow: what is not a number counts as 0.
std::uint64_t to_cell(double x) {
  constexpr double kLastCell = (1 << kBitsPerAxis) - 1;
  return x > 0 ? static_cast<std::uint64_t>(std::min(x, kLastCell)) : 0;
}

/// Triangles along the curve: place -> old triangle.
std::vector<TriangleId> morton_order(const RepairedMesh& mesh) {
  const Box box = box_of(mesh.positions);
  Vec3 cells_per_unit;  // of three times the centroid, which saves the division
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = box.high[axis] - box.low[axis];
    cells_per_unit[axis] = extent > 0 ? ((1 << kBitsPerAxis) - 1) / (3 * extent) : 0;
  }
  std::vector<std::pair<std::uint64_t, TriangleId>> keys(mesh.table.triangle_count());
  for (TriangleId t = 0; t < keys.size(); ++t) {
    const auto [a, b, c] = mesh.table.triangle(t);
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double sum = (mesh.positions[a][axis] - box.low[axis]) +
                         (mesh.positions[b][axis] - box.low[axis]) +
                         (mesh.positions[c][axis] - box.low[axis]);
      key |= spread_bits(to_cell(sum * cells_per_unit[axis])) << axis;
    }
    keys[t] = {key, t};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<TriangleId> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

/// vertex -> place in the order in which the triangles of `order` first name it.
std::vector<VertexId> number_by_first_use(const CornerTable& table, const std::vector<TriangleId>& order) {
  std::vector<VertexId> new_of_old(table.vertex_count(), kNone);
  VertexId used = 0;
  for (TriangleId t : order) {
    for (VertexId v : table.triangle(t)) {
      if (new_of_old[v] == kNone) new_of_old[v] = used++;
    }
  }
  return new_of_old;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& permutation) {
  std::vector<std::uint32_t> inverted(permutation.size());
  for (std::uint32_t i = 0; i < permutation.size(); ++i) inverted[permutation[i]] = i;
  return inverted;
}

CornerTable renumbered(const CornerTable& table, const std::vector<TriangleId>& order,
                       const std::vector<VertexId>& new_of_old_vertex) {
  const std::vector<TriangleId> new_of_old_triangle = inverse(order);
  CornerTable to;
  to.vertex_of_corner.reserve(table.corner_count());
  to.opposite.reserve(table.corner_count());
  for (TriangleId t : order) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      const CornerId across = table.opposite[c];
      to.vertex_of_corner.push_back(new_of_old_vertex[table.vertex(c)]);
      to.opposite.push_back(across == kNone ? kNone
                                            : 3 * new_of_old_triangle[triangle_of(across)] + across % 3);
    }
  }
  to.set_corner_of_vertex(table.vertex_count());
  return to;
}

}  // namespace

RepairedMesh spatially_ordered(RepairedMesh mesh) {
  const std::vector<TriangleId> triangles = morton_order(mesh);
  const std::vector<VertexId> new_of_old_vertex = number_by_first_use(mesh.table, triangles);
  const std::vector<VertexId> vertices = inverse(new_of_old_vertex);
  mesh.table = renumbered(mesh.table, triangles, new_of_old_vertex);
  mesh.positions = gathered(mesh.positions, vertices);
  mesh.source_of_vertex = gathered(mesh.source_of_vertex, vertices);
  mesh.source_of_triangle = gathered(mesh.source_of_triangle, triangles);
  mesh.is_turned = gathered(mesh.is_turned, triangles);
  return mesh;
}

}  // namespace selvage
