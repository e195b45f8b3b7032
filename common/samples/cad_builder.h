// SPDX-License-Identifier: MIT
//
// Builds boundary models as a CAD kernel tessellates them: planar faces with holes, walls between loops, long
// thin triangles beside fine ones. Points that are stated twice at the same place become one vertex, so faces
// that state the same edge points meet without cracks.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/mesh/triangle_soup.h"

namespace selvage {

using Loop = std::vector<Vec3>;

/// Axes of a part that stands on the plane of u and v and grows along w. Right-handed.
struct Frame {
  Vec3 origin, u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};

  Vec3 at(double x, double y, double z) const { return origin + u * x + v * y + w * z; }
};

/// `points` points on a circle around the frame's w axis at height `z`, counter-clockwise seen from +w.
Loop circle(const Frame& frame, double radius, double z, int points);

class CadBuilder {
 public:
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c);
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

  /// A planar face that looks along `normal`; loops in any direction.
  void face(const Vec3& normal, const Loop& outer, std::span<const Loop> holes = {});

  /// Quads between two closed loops of equal length that lie over one another, cut into `rings` along the
  /// way. Looks away from the axis if the loops are counter-clockwise seen from `to`; with `from` and `to`
  /// exchanged, towards it.
  void wall(const Loop& from, const Loop& to, int rings = 1);

  TriangleSoup take() { return std::move(soup_); }

 private:
  std::uint32_t vertex(const Vec3& p);

  TriangleSoup soup_;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> vertex_at_;  // by position in millionths of a unit
};

}  // namespace selvage
