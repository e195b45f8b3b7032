// SPDX-License-Identifier: MIT
#include "common/codec/connectivity.h"

#include <algorithm>
#include <numeric>

namespace selvage {
namespace {

bool is_strictly_ascending_below(std::span<const VertexId> vertices, std::uint32_t limit) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] >= limit || (i > 0 && vertices[i] <= vertices[i - 1])) return false;
  }
  return true;
}

/// The triangles around virtual vertices, ascending. Nothing if a vertex is not inside the mesh.
std::optional<std::vector<TriangleId>> virtual_fans(const CornerTable& table,
                                                    std::span<const VertexId> virtual_vertices) {
  std::vector<TriangleId> fans;
  for (VertexId v : virtual_vertices) {
    const CornerId first = table.corner_of_vertex[v];
    if (first == kNone) return std::nullopt;
    CornerId c = first;
    do {
      fans.push_back(triangle_of(c));
      c = table.swing_ccw(c);
      if (c == kNone) return std::nullopt;
    } while (c != first);
  }
  std::sort(fans.begin(), fans.end());
  fans.erase(std::unique(fans.begin(), fans.end()), fans.end());
  return fans;
}

void open_edges(CornerTable& table, TriangleId t) {
  for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
    if (table.opposite[c] != kNone) table.opposite[table.opposite[c]] = kNone;
    table.opposite[c] = kNone;
  }
}

void move_triangle(CornerTable& table, TriangleId from, TriangleId to) {
  for (CornerId k = 0; k < 3; ++k) {
    const CornerId across = table.opposite[3 * from + k];
    table.vertex_of_corner[3 * to + k] = table.vertex_of_corner[3 * from + k];
    table.opposite[3 * to + k] = across;
    if (across != kNone) table.opposite[across] = 3 * to + k;
  }
}

/// Takes triangles away; the last ones of those that stay move to the places that fall free, lowest place
/// first. Returns their former numbers.
std::vector<TriangleId> drop_triangles(CornerTable& table, std::span<const TriangleId> dropped) {
  std::vector<TriangleId> former(table.triangle_count());
  std::iota(former.begin(), former.end(), TriangleId{0});
  for (TriangleId t : dropped) open_edges(table, t);
  TriangleId end = table.triangle_count();
  for (std::size_t low = 0, high = dropped.size(); low < high; ++low) {
    while (low < high && dropped[high - 1] == end - 1) --high, --end;
    if (low == high) break;
    move_triangle(table, --end, dropped[low]);
    former[dropped[low]] = end;
  }
  former.resize(end);
  table.vertex_of_corner.resize(3 * std::size_t{end});
  table.opposite.resize(3 * std::size_t{end});
  return former;
}

}  // namespace

std::optional<Connectivity> finish_connectivity(CornerTable grown,
                                                std::span<const VertexId> virtual_vertices) {
  if (!is_strictly_ascending_below(virtual_vertices, grown.vertex_count())) return std::nullopt;
  const auto dropped = virtual_fans(grown, virtual_vertices);
  if (!dropped) return std::nullopt;
  Connectivity result;
  if (!dropped->empty()) result.grown_of_triangle = drop_triangles(grown, *dropped);
  result.table = std::move(grown);
  return result;
}

}  // namespace selvage
