// SPDX-License-Identifier: MIT
#include "server/segment/geodesic.h"

#include <algorithm>
#include <cmath>

namespace selvage {
namespace {

constexpr int kMaxTriangles = 1024;

struct Vec2 {
  double x = 0, y = 0;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(Vec2 a, double s) { return {a.x * s, a.y * s}; }
};

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

Vec2 choose(bool first, Vec2 a, Vec2 b) { return {first ? a.x : b.x, first ? a.y : b.y}; }

/// The part of the plane that the line is in: a triangle unfolded, leaving through the edge a-b.
struct Unfolded {
  CornerId facing;  ///< the corner that faces the edge; a is the vertex after it, b the one before it
  Vec2 third, a, b;
};

/// The point at `at` of the unfolded triangle, on the surface. A triangle without area yields its middle.
Vec3 lift(const CornerTable& mesh, std::span<const Vec3> positions, const Unfolded& in, Vec2 at) {
  const double area = cross(in.a - in.third, in.b - in.third);
  double weight_a = 1.0 / 3, weight_b = 1.0 / 3;
  if (area > 0) {
    weight_a = std::clamp(cross(at - in.third, in.b - in.third) / area, 0.0, 1.0);
    weight_b = std::clamp(cross(in.a - in.third, at - in.third) / area, 0.0, 1.0);
  }
  const Vec3 third = positions[mesh.vertex(in.facing)];
  return third + (positions[mesh.vertex(next(in.facing))] - third) * weight_a +
         (positions[mesh.vertex(prev(in.facing))] - third) * weight_b;
}

}  // namespace

GeodesicTracer::GeodesicTracer(const CornerTable& mesh, std::span<const Vec3> positions)
    : mesh_(mesh), positions_(positions), beyond_corner_(mesh.corner_count()) {
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    const CornerId across = mesh.opposite[c];
    if (across == kNone) continue;
    const Vec3 origin = positions[mesh.vertex(prev(c))];
    const Vec3 edge = positions[mesh.vertex(next(c))] - origin,
               apex = positions[mesh.vertex(across)] - origin;
    const double squared = dot(edge, edge);
    // On an edge without length the apex stays at its end, where a line through it comes to rest.
    const double scale = squared > 0 ? 1 / squared : 0;
    beyond_corner_[c] = {across, static_cast<float>(dot(apex, edge) * scale),
                         static_cast<float>(length(selvage::cross(edge, apex)) * scale)};
  }
}

GeodesicEnd GeodesicTracer::trace(CornerId start, double angle, double length) const {
  const Vec3 origin = positions_[mesh_.vertex(start)];
  const Vec3 to_a = positions_[mesh_.vertex(next(start))] - origin;
  const Vec3 to_b = positions_[mesh_.vertex(prev(start))] - origin;
  const double length_a = selvage::length(to_a);
  if (!(length_a > 0)) return {origin, 0};
  const Vec2 direction{std::cos(angle), std::sin(angle)};
  Unfolded in{start,
              {},
              {length_a, 0},
              {dot(to_a, to_b) / length_a, selvage::length(selvage::cross(to_a, to_b)) / length_a}};

  double reached = 0;
  for (int triangle = 0; triangle < kMaxTriangles; ++triangle) {
    const Vec2 edge = in.b - in.a;
    // The line meets the edge after along / across; compared without dividing.
    const double along = cross(in.a, edge), across = cross(direction, edge);
    if (along >= length * across) return {lift(mesh_, positions_, in, direction * length), length};
    const Beyond& beyond = beyond_corner_[in.facing];
    if (beyond.corner == kNone || triangle + 1 == kMaxTriangles) {
      reached = along / across;
      break;
    }
    const Vec2 back = in.a - in.b;  // the edge as the next triangle runs along it
    const Vec2 placed = in.b + back * beyond.x + Vec2{-back.y, back.x} * beyond.y;
    // Which way is a coin toss, so values are chosen rather than branches taken.
    const bool is_left = cross(direction, placed) > 0;
    const CornerId first = beyond.corner / 3 * 3, place = beyond.corner - first;
    const CornerId turned = is_left ? (place == 2 ? 0 : place + 1) : (place == 0 ? 2 : place - 1);
    in = {first + turned, choose(is_left, in.b, in.a), choose(is_left, in.a, placed),
          choose(is_left, placed, in.b)};
  }
  if (!(reached > 0)) return {origin, 0};
  return {lift(mesh_, positions_, in, direction * reached), reached};
}

}  // namespace selvage
