// SPDX-License-Identifier: MIT
#include "server/simplify/vertex_classes.h"

namespace selvage {
namespace {

VertexClass class_of_loop_vertex(const CornerTable& mesh, std::span<const RegionId> region_of_vertex,
                                 VertexId v) {
  const RegionId own = region_of_vertex[v];
  RegionId foreign = kNone;
  bool has_region_triangle = false;
  const CornerId first = mesh.corner_of_vertex[v];
  CornerId c = first;
  do {
    const RegionId a = region_of_vertex[mesh.vertex(next(c))], b = region_of_vertex[mesh.vertex(prev(c))];
    for (const RegionId label : {a, b}) {
      if (label == own) continue;
      if (foreign != kNone && foreign != label) return VertexClass::Pinned;
      foreign = label;
    }
    has_region_triangle |= a == own && b == own;
    c = mesh.swing_ccw(c);
  } while (c != kNone && c != first);
  const bool is_closed = c == first;
  return is_closed && has_region_triangle && own != kLooseRegion ? VertexClass::Chain : VertexClass::Pinned;
}

}  // namespace

std::vector<VertexClass> classify_vertices(const CornerTable& mesh,
                                           std::span<const RegionId> region_of_vertex,
                                           std::span<const VertexId> pinned) {
  std::vector<VertexClass> classes(mesh.vertex_count(), VertexClass::Interior);
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const VertexId a = mesh.vertex(next(c)), b = mesh.vertex(prev(c));
    if (mesh.opposite[c] == kNone) classes[a] = classes[b] = VertexClass::Border;
  }
  if (!region_of_vertex.empty()) {
    const auto label = [&](CornerId c) { return region_of_vertex[mesh.vertex(c)]; };
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
      const CornerId c = 3 * t;
      if (label(c) == label(c + 1) && label(c) == label(c + 2) && label(c) != kLooseRegion) continue;
      for (CornerId corner = c; corner < c + 3; ++corner) {
        const VertexId v = mesh.vertex(corner);
        if (classes[v] == VertexClass::Chain || classes[v] == VertexClass::Pinned) continue;
        classes[v] = class_of_loop_vertex(mesh, region_of_vertex, v);
      }
    }
  }
  for (const VertexId v : pinned) classes[v] = VertexClass::Pinned;
  return classes;
}

bool is_allowed(VertexClass vertex_class, std::span<const RegionId> region_of_vertex, const Star& star,
                std::uint32_t place) {
  switch (vertex_class) {
    case VertexClass::Interior:
      return true;
    case VertexClass::Border:
      return place == 0 || place + 1 == star.ring_size();
    case VertexClass::Pinned:
      return false;
    case VertexClass::Chain:
      break;
  }
  const RegionId own = region_of_vertex[star.centre];
  const auto is_own = [&](std::uint32_t at) { return region_of_vertex[star.ring[at]] == own; };
  return is_own(place) && is_own(star.next_place(place)) != is_own(star.previous_place(place));
}

/// The piece is the triangle alone if boundary triangles lie beyond its other two edges as well.
bool keeps_region(const CornerTable& mesh, std::span<const RegionId> region_of_vertex, const Star& star,
                  std::uint32_t place) {
  const RegionId own = region_of_vertex[star.centre];
  const bool is_after = region_of_vertex[star.ring[star.next_place(place)]] == own;
  const CornerId at_centre =
      star.corners[is_after ? star.triangle_after(place) : star.triangle_before(place)];
  const CornerId at_target = is_after ? next(at_centre) : prev(at_centre);
  for (const CornerId c : {at_centre, at_target}) {
    const CornerId beyond = mesh.opposite[c];
    if (beyond != kNone && region_of_vertex[mesh.vertex(beyond)] == own) return true;
  }
  return false;
}

}  // namespace selvage
