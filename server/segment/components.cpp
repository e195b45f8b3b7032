// SPDX-License-Identifier: MIT
#include "server/segment/components.h"

#include "server/segment/one_ring.h"

namespace selvage {

Components find_components(const CornerTable& mesh) {
  Components components{std::vector<std::uint32_t>(mesh.vertex_count(), kNone), {}};
  std::vector<VertexId> pending;
  for (VertexId seed = 0; seed < mesh.vertex_count(); ++seed) {
    if (components.of_vertex[seed] != kNone) continue;
    const std::uint32_t id = components.count();
    std::uint32_t size = 0;
    components.of_vertex[seed] = id;
    pending.push_back(seed);
    while (!pending.empty()) {
      const VertexId v = pending.back();
      pending.pop_back();
      ++size;
      for_each_neighbour(mesh, v, [&](VertexId u) {
        if (components.of_vertex[u] != kNone) return;
        components.of_vertex[u] = id;
        pending.push_back(u);
      });
    }
    components.vertex_count.push_back(size);
  }
  return components;
}

std::vector<ComponentShape> measure_components(const CornerTable& mesh, std::span<const Vec3> positions,
                                               const Components& components) {
  std::vector<ComponentShape> shapes(components.count());
  std::vector<double> volume(components.count(), 0.0);
  std::vector<VertexId> anchor(components.count(), kNone);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [i, j, k] = mesh.triangle(t);
    const std::uint32_t component = components.of_vertex[i];
    if (anchor[component] == kNone) anchor[component] = i;
    const Vec3 origin = positions[anchor[component]];
    const Vec3 a = positions[i] - origin, b = positions[j] - origin, c = positions[k] - origin;
    shapes[component].area += 0.5 * length(cross(b - a, c - a));
    volume[component] += dot(a, cross(b, c));
  }
  for (std::uint32_t i = 0; i < components.count(); ++i) shapes[i].outward = volume[i] < 0 ? -1 : 1;
  return shapes;
}

}  // namespace selvage
