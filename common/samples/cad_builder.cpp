// SPDX-License-Identifier: MIT
#include "common/samples/cad_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/samples/triangulate.h"

namespace selvage {
namespace {

double area_of(const std::vector<Point2>& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

}  // namespace

Loop circle(const Frame& frame, double radius, double z, int points) {
  Loop loop;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    loop.push_back(frame.at(radius * std::cos(angle), radius * std::sin(angle), z));
  }
  return loop;
}

std::uint32_t CadBuilder::vertex(const Vec3& p) {
  const std::array<std::int64_t, 3> key = {std::llround(p.x * 1e6), std::llround(p.y * 1e6),
                                           std::llround(p.z * 1e6)};
  const auto [it, is_new] = vertex_at_.try_emplace(key, static_cast<std::uint32_t>(soup_.positions.size()));
  if (is_new) soup_.positions.push_back(p);
  return it->second;
}

void CadBuilder::triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::uint32_t ia = vertex(a), ib = vertex(b), ic = vertex(c);
  soup_.triangles.push_back({ia, ib, ic});
}

void CadBuilder::quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void CadBuilder::face(const Vec3& normal, const Loop& outer, std::span<const Loop> holes) {
  const Vec3 n = normalised(normal);
  const Vec3 u = normalised(std::abs(n.x) < 0.8 ? cross({1, 0, 0}, n) : cross({0, 1, 0}, n)), v = cross(n, u);

  std::vector<Vec3> corners;
  std::vector<std::vector<Point2>> flat;
  const auto add = [&](Loop loop, bool counter_clockwise) {
    const auto flattened = [&] {
      std::vector<Point2> points;
      for (const Vec3& p : loop) points.push_back({dot(p, u), dot(p, v)});
      return points;
    };
    if ((area_of(flattened()) > 0) != counter_clockwise) std::ranges::reverse(loop);
    flat.push_back(flattened());
    corners.insert(corners.end(), loop.begin(), loop.end());
  };
  add(outer, true);
  for (const Loop& hole : holes) add(hole, false);
  for (const auto& [a, b, c] : triangulate(flat)) triangle(corners[a], corners[b], corners[c]);
}

void CadBuilder::wall(const Loop& from, const Loop& to, int rings) {
  const auto at = [&](std::size_t i, int ring) {
    const double t = static_cast<double>(ring) / rings;
    const std::size_t k = i % from.size();
    return ring == rings ? to[k] : from[k] + (to[k] - from[k]) * t;
  };
  for (int ring = 0; ring < rings; ++ring)
    for (std::size_t i = 0; i < from.size(); ++i)
      quad(at(i, ring), at(i + 1, ring), at(i + 1, ring + 1), at(i, ring + 1));
}

}  // namespace selvage
