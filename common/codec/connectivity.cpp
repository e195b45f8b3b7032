// SPDX-License-Identifier: MIT
#include "common/codec/connectivity.h"

#include <algorithm>

namespace selvage {
namespace {

bool is_strictly_ascending_below(std::span<const VertexId> vertices, std::uint32_t limit) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] >= limit || (i > 0 && vertices[i] <= vertices[i - 1])) return false;
  }
  return true;
}

/// The triangles around virtual vertices, ascending. Nothing if a vertex is not inside the mesh.
std::optional<std::vector<TriangleId>> virtual_fans(const FanTable& table,
                                                    std::span<const VertexId> virtual_vertices) {
  std::vector<TriangleId> fans;
  for (VertexId v : virtual_vertices) {
    if (table.at(v).closed_fan() == 0) return std::nullopt;
    const FanCorner first = next_on(table.at(v).corner);
    FanCorner rim = first;
    do {
      fans.push_back(triangle_on(rim));
      rim = table.turn(rim);
    } while (rim != first);
  }
  std::sort(fans.begin(), fans.end());
  fans.erase(std::unique(fans.begin(), fans.end()), fans.end());
  return fans;
}

}  // namespace

std::optional<std::vector<TriangleId>> drop_virtual_fans(FanTable& table,
                                                         std::span<const VertexId> virtual_vertices) {
  if (!is_strictly_ascending_below(virtual_vertices, table.vertex_count())) return std::nullopt;
  const auto fans = virtual_fans(table, virtual_vertices);
  if (!fans) return std::nullopt;
  if (fans->empty()) return std::vector<TriangleId>{};
  return table.drop(*fans);
}

}  // namespace selvage
