// SPDX-License-Identifier: MIT
#include "server/simplify/legality.h"

namespace selvage {
namespace {

constexpr double kLeastCosine = 0.2;
constexpr double kLeastAreaShare = 1e-7;

/// Marks everything that shares an edge with v. False if two edges lead to the same vertex.
bool mark_neighbours(const CornerTable& mesh, VertexId v, Stamps& stamps) {
  const CornerId first = mesh.corner_of_vertex[v];
  CornerId c = first;
  while (true) {
    if (!stamps.insert(mesh.vertex(next(c)))) return false;
    const CornerId left = mesh.swing_ccw(c);
    if (left == kNone) return stamps.insert(mesh.vertex(prev(c)));
    if (left == first) return true;
    c = left;
  }
}

/// Whether v would still have a surface if one of its triangles went: a closed fan of three or an open one of
/// two.
bool can_lose_a_triangle(const CornerTable& mesh, VertexId v) {
  const CornerId first = mesh.corner_of_vertex[v];
  std::uint32_t count = 1;
  for (CornerId c = mesh.swing_ccw(first); count < 4; c = mesh.swing_ccw(c), ++count) {
    if (c == kNone) return count > 1;
    if (c == first) return false;
  }
  return true;
}

Vec3 normal_after(const Star& star, std::uint32_t triangle, std::uint32_t place) {
  const Vec3& v = star.points[place];
  return cross(star.points[triangle] - v, star.second_point(triangle) - v);
}

/// Def. 3.2 by the sign of eq. 3.7, with h = |n| / |v0 v2|. Needs a triangle on both sides of the ring
/// vertex.
bool is_ring_concave(const Star& star, std::uint32_t place) {
  const std::uint32_t before = star.triangle_before(place), after = star.triangle_after(place);
  if (before == kNone || after == kNone) return false;
  const Vec3& v2 = star.points[place];
  const Vec3 to_centre = star.centre_point - v2;
  const double left = dot(to_centre, star.points[star.next_place(place)] - v2);
  const double right = dot(to_centre, star.points[star.previous_place(place)] - v2);
  return star.double_areas[before] * left + star.double_areas[after] * right < 0;
}

}  // namespace

bool keeps_manifold(const CornerTable& mesh, const Star& star, std::uint32_t place, Stamps& stamps) {
  const std::uint32_t going = star.triangles_at_edge(place);
  if (star.size() <= going) return false;
  stamps.clear();
  if (!mark_neighbours(mesh, star.ring[place], stamps)) return false;
  std::uint32_t common = 0;
  for (const VertexId w : star.ring) common += stamps.contains(w);
  if (common != going) return false;
  if (star.triangle_after(place) != kNone && !can_lose_a_triangle(mesh, star.ring[star.next_place(place)])) {
    return false;
  }
  return star.triangle_before(place) == kNone ||
         can_lose_a_triangle(mesh, star.ring[star.previous_place(place)]);
}

bool keeps_normals(const Star& star, std::uint32_t place) {
  const double least_length = kLeastAreaShare * star.sum_of_double_areas;
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (star.is_at_edge(i, place)) continue;
    Vec3 before = star.normals[i];
    double before_length = star.double_areas[i];
    if (before_length <= least_length) {
      before = {};
      for (const Vec3& normal : star.normals) before += normal;
      before_length = length(before);
    }
    const Vec3 after = normal_after(star, i, place);
    const double after_length = length(after);
    if (!(after_length > least_length)) return false;
    if (!(dot(after, before) > kLeastCosine * after_length * before_length)) return false;
  }
  return true;
}

bool keeps_convexity(const Star& star, std::uint32_t place) {
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (!star.is_at_edge(i, place) && !(length(normal_after(star, i, place)) > 0)) return false;
  }
  return !is_ring_concave(star, star.next_place(place)) && !is_ring_concave(star, star.previous_place(place));
}

}  // namespace selvage
