// SPDX-License-Identifier: MIT
#include "server/segment/vertex_measures.h"

namespace selvage {

VertexMeasures measure_vertices(const CornerTable& mesh, std::span<const Vec3> positions) {
  VertexMeasures measures{std::vector<float>(mesh.vertex_count(), 0),
                          std::vector<float>(mesh.vertex_count(), 0)};
  std::vector<float> edge_weight(mesh.vertex_count(), 0);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto corners = mesh.triangle(t);
    const Vec3 edge[3] = {positions[corners[1]] - positions[corners[0]],
                          positions[corners[2]] - positions[corners[1]],
                          positions[corners[0]] - positions[corners[2]]};
    const auto third_of_area = static_cast<float>(length(cross(edge[0], edge[1])) / 6);
    for (std::uint32_t i = 0; i < 3; ++i) {
      measures.area[corners[i]] += third_of_area;
      // An inner edge comes twice, once from each side; a border edge counts double to have the same weight.
      const bool is_border = mesh.opposite[3 * t + (i + 2) % 3] == kNone;
      const float weight = is_border ? 2.0f : 1.0f;
      const auto weighted = static_cast<float>(length(edge[i])) * weight;
      for (VertexId v : {corners[i], corners[(i + 1) % 3]}) {
        measures.mean_edge[v] += weighted;
        edge_weight[v] += weight;
      }
    }
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (edge_weight[v] > 0) measures.mean_edge[v] /= edge_weight[v];
  }
  return measures;
}

}  // namespace selvage
