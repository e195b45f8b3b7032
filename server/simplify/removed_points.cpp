// SPDX-License-Identifier: MIT
#include "server/simplify/removed_points.h"

#include <limits>

namespace selvage {
namespace {

/// The squared distance to the nearest triangle, or any value up to `enough` if that is not more.
double squared_distance(std::span<const PreparedTriangle> triangles, const Vec3& p, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (const PreparedTriangle& triangle : triangles) {
    least = std::min(least, triangle.squared_distance(p));
    if (least <= enough) break;
  }
  return least;
}

}  // namespace

void RemovedPoints::prepare_new_triangles(const Star& star, std::uint32_t place) {
  new_triangles_.clear();
  index_in_star_.clear();
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (star.is_at_edge(i, place)) continue;
    new_triangles_.emplace_back(star.points[place], star.points[i], star.second_point(i));
    index_in_star_.push_back(i);
  }
}

/// New edges lead from the target to the ring vertices that it was not next to.
double RemovedPoints::farthest_edge_middle(const Star& star, std::uint32_t place, double at_least) {
  old_triangles_.clear();
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    old_triangles_.emplace_back(star.centre_point, star.points[i], star.second_point(i));
  }
  for (std::uint32_t other = 0; other < star.ring_size(); ++other) {
    const bool was_edge = other == place ||
                          (star.triangle_after(place) != kNone && other == star.next_place(place)) ||
                          (star.triangle_before(place) != kNone && other == star.previous_place(place));
    if (was_edge) continue;
    const Vec3 middle = (star.points[place] + star.points[other]) * 0.5;
    at_least = std::max(at_least, squared_distance(old_triangles_, middle, at_least));
  }
  return at_least;
}

double RemovedPoints::squared_deviation(const Star& star, std::uint32_t place) {
  prepare_new_triangles(star, place);
  double farthest = squared_distance(new_triangles_, star.centre_point, 0);
  for (const CornerId c : star.corners) {
    for (VertexId p = first_of_triangle_[triangle_of(c)]; p != kNone; p = next_of_vertex_[p]) {
      farthest = std::max(farthest, squared_distance(new_triangles_, positions_[p], farthest));
    }
  }
  return farthest_edge_middle(star, place, farthest);
}

void RemovedPoints::collapse(const Star& star, std::uint32_t place) {
  prepare_new_triangles(star, place);
  // All points of the star in one list, then each to its new place.
  VertexId all = star.centre;
  next_of_vertex_[star.centre] = kNone;
  for (const CornerId c : star.corners) {
    VertexId p = first_of_triangle_[triangle_of(c)];
    first_of_triangle_[triangle_of(c)] = kNone;
    while (p != kNone) {
      const VertexId following = next_of_vertex_[p];
      next_of_vertex_[p] = all;
      all = p;
      p = following;
    }
  }
  while (all != kNone) {
    const VertexId p = all;
    all = next_of_vertex_[p];
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < new_triangles_.size(); ++i) {
      const double distance = new_triangles_[i].squared_distance(positions_[p]);
      if (distance < least) least = distance, nearest = i;
    }
    std::uint32_t& first = first_of_triangle_[triangle_of(star.corners[index_in_star_[nearest]])];
    next_of_vertex_[p] = first;
    first = p;
  }
}

}  // namespace selvage
