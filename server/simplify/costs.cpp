// SPDX-License-Identifier: MIT
#include "server/simplify/costs.h"

#include <cmath>

namespace selvage {
namespace {

double squared(double x) { return x * x; }

double squared_distance_to_line(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, to_p = p - a;
  const double along_squared = dot(along, along);
  if (along_squared == 0) return dot(to_p, to_p);
  const Vec3 across = cross(along, to_p);
  return dot(across, across) / along_squared;
}

/// Eq. 3.4 with h_i = |N_i| / l.
double edge_curvature(const Star& star, std::uint32_t place) {
  const std::uint32_t before = star.triangle_before(place), after = star.triangle_after(place);
  if (before == kNone || after == kNone) return 0;
  const double n1 = star.double_areas[before], n2 = star.double_areas[after];
  if (n1 == 0 || n2 == 0) return 0;
  const Vec3 edge = star.points[place] - star.centre_point;
  return dot(edge, edge) * (1 - dot(star.normals[before], star.normals[after]) / (n1 * n2)) / (n1 + n2);
}

/// Eq. 3.5.
double area_change(const Star& star, std::uint32_t place) {
  const Vec3& v = star.points[place];
  double after = 0;
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (!star.is_at_edge(i, place)) after += length(cross(star.points[i] - v, star.second_point(i) - v));
  }
  const double before = star.sum_of_double_areas;
  return before > 0 ? squared(before - after) / (2 * before) : 0;
}

}  // namespace

double star_weight(const Star& star, double mean_area) {
  const double area = star.sum_of_double_areas / 2;
  return mean_area > 0 ? std::sqrt(std::sqrt(area / (6 * mean_area))) : 1;
}

double plane_distance_cost(const Star& star, std::uint32_t place, double mean_area) {
  // With N = 2 A n, A d^2 = (N.w)^2 / (2 |N|), and the sum of A is half that of |N|.
  const Vec3 w = star.points[place] - star.centre_point;
  double sum = 0;
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (star.double_areas[i] > 0) sum += squared(dot(star.normals[i], w)) / star.double_areas[i];
  }
  double cost = star.sum_of_double_areas > 0 ? sum / star.sum_of_double_areas : 0;
  if (!star.is_closed) {
    const std::uint32_t other_end = place == 0 ? star.ring_size() - 1 : 0;
    cost += squared_distance_to_line(star.centre_point, star.points[place], star.points[other_end]);
  }
  return cost * star_weight(star, mean_area);
}

double edge_area_cost(const Star& star, std::uint32_t place, double mean_area) {
  const double change = area_change(star, place);
  return edge_curvature(star, place) + (mean_area > 0 ? change / mean_area : change);
}

}  // namespace selvage
