// SPDX-License-Identifier: MIT
//
// How far triangles reach from a surface, as a bound and not as a sample: the distance from one triangle is
// convex, so a convex piece lies as near to it as its corners do. A piece that the triangle nearest to its
// middle does not cover is clipped to that triangle's prism, and what is outside looks for another one
// [compare Guthe et al. 2005, Tang et al. 2009].
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"
#include "common/mesh/vec3.h"
#include "server/simplify/point_triangle.h"

namespace selvage {

/// Triangles to find near ones among. A tree of boxes over the triangles in their order: cheap to build, and
/// as good as the order is (see spatially_ordered). Immutable, so threads may share it.
class TriangleTree {
 public:
  /// Both are borrowed. `triangles` must not be empty.
  TriangleTree(std::span<const Triangle> triangles, std::span<const Vec3> positions);

  struct Near {
    std::uint32_t triangle;
    double squared_distance;
  };
  /// A node still to be looked into, and how far its box is, squared.
  struct Open {
    std::uint32_t node;
    double squared_distance;
  };
  /// The triangle nearest to p among those nearer than `nearer_than`, squared; kNone if there is none.
  /// `stack` is scratch.
  Near nearest(const Vec3& p, double nearer_than, std::vector<Open>& stack) const;
  PreparedTriangle prepared(std::uint32_t i) const;

 private:
  struct Box {
    Vec3 low, high;
    double squared_distance(const Vec3& p) const {
      const auto past = [](double at, double from, double to) {
        const double below = from - at, above = at - to;
        const double most = below > above ? below : above;
        return most > 0 ? most * most : 0;
      };
      return past(p.x, low.x, high.x) + past(p.y, low.y, high.y) + past(p.z, low.z, high.z);
    }
  };

  std::span<const Triangle> triangles_;
  std::span<const Vec3> positions_;
  std::uint32_t leaves_ = 1;  // a power of two
  std::vector<Box> boxes_;    // of node n: children 2n and 2n + 1; leaves from leaves_ on
};

/// A bound on how far the triangles given to it are from a surface. It rises as they come, never more than
/// they force it to but for a tenth.
class CoverBound {
 public:
  /// What lies within `begin` > 0 of the surface makes no difference.
  CoverBound(const TriangleTree& surface, double begin) : surface_(surface), bound_(begin) {}

  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  double bound() const { return bound_; }

 private:
  /// A convex polygon.
  struct Piece {
    static constexpr std::uint32_t kMost = 12;
    std::array<Vec3, kMost> corners;
    std::uint32_t count = 0;
    void push(const Vec3& p) { corners[count++] = p; }
    Vec3 middle() const;
    double extent() const;
  };

  double reach(const PreparedTriangle& triangle, const Piece& piece) const;
  void cover(const Piece& piece);
  bool clip_to(const PreparedTriangle& triangle, Piece piece);
  void halve(const Piece& piece);
  static void cut(const Piece& piece, const Vec3& normal, double offset, Piece& above, Piece& below);

  const TriangleTree& surface_;
  double bound_;
  std::uint32_t last_ = 0;  // nearest to the piece before, and so likely near the next
  std::vector<Piece> pieces_;
  std::vector<TriangleTree::Open> stack_;
};

}  // namespace selvage
