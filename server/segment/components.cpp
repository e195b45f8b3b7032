// SPDX-License-Identifier: MIT
#include "server/segment/components.h"

#include <algorithm>
#include <numeric>

namespace selvage {

namespace {

/// Union-find over vertices; the root of a set is its lowest vertex.
class VertexSets {
 public:
  explicit VertexSets(std::uint32_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  VertexId root(VertexId v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(VertexId a, VertexId b) {
    a = root(a), b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<VertexId> parent_;
};

}  // namespace

Components find_components(const CornerTable& mesh) {
  VertexSets sets(mesh.vertex_count());
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    sets.join(a, b);
    sets.join(a, c);
  }
  Components components{std::vector<std::uint32_t>(mesh.vertex_count()), {}};
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const VertexId root = sets.root(v);  // not above v, so numbered before it
    if (root == v) {
      components.of_vertex[v] = components.count();
      components.vertex_count.push_back(0);
    }
    components.of_vertex[v] = components.of_vertex[root];
    ++components.vertex_count[components.of_vertex[v]];
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
