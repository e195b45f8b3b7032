// SPDX-License-Identifier: MIT
//
// How far triangles reach from a surface, as a bound and not as a sample: the distance from one triangle is
// convex, so a convex piece lies as near to it as its corners do. A piece walks over the surface to the
// triangle that its middle is over; what of it that one does not cover is clipped off, and goes on to the
// triangle next door [compare Guthe et al. 2005, Tang et al. 2009]. Only where walking does not help, in
// creases and at borders, is the nearest triangle searched for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/vec3.h"
#include "server/simplify/near_surface.h"

namespace selvage {

struct ConvexPiece {
  static constexpr std::uint32_t kMost = 12;
  std::array<Vec3, kMost> corners;
  std::uint32_t count = 0;

  void push(const Vec3& p) { corners[count++] = p; }
  Vec3 middle() const;
  /// At least half its diameter.
  double extent() const;
};

/// What a piece may lie on: a surface, or those of its triangles that are inside one region.
struct CoverTarget {
  const NearSurface* surface;
  RegionId only = kNone;
};

/// A piece that came to lie on `triangle` of the first target, outside of the region it belongs to.
struct Stray {
  ConvexPiece piece;
  std::uint32_t triangle;
};

/// A bound on how far the pieces given to it are from its targets. It rises as they come, never more than
/// they force it to but for a tenth.
class CoverBound {
 public:
  /// What lies within `begin` > 0 of the targets makes no difference. `targets` are borrowed, and not empty.
  CoverBound(std::span<const CoverTarget> targets, double begin) : targets_(targets), bound_(begin) {}

  /// From now on strays from `home` are put there too.
  void keep_strays(RegionId home, std::vector<Stray>& strays) { home_ = home, strays_ = &strays; }

  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  void add(const ConvexPiece& piece);
  double bound() const { return bound_; }

 private:
  struct Place {
    std::uint32_t target = 0, triangle = kNone;
  };
  struct Work {
    ConvexPiece piece;
    Place near;  ///< where to look first
  };

  void cover(const Work& work);
  PreparedTriangle walk(Place& place, const Vec3& to) const;
  bool lands(const ConvexPiece& piece, const PreparedTriangle& triangle, const Place& place);
  bool clip_to(const PreparedTriangle& triangle, const Place& place, ConvexPiece piece);
  void halve(const ConvexPiece& piece, const Place& near);
  void note(const ConvexPiece& piece, const Place& place);
  double search(const Vec3& p, double nearer_than, Place& place);
  bool is_open_to(std::uint32_t target, std::uint32_t triangle) const;

  std::span<const CoverTarget> targets_;
  double bound_;
  Place last_;  // of the piece before, and so likely near the next
  std::vector<Work> pile_;
  std::vector<NearSurface::Open> stack_;
  RegionId home_ = kNone;
  std::vector<Stray>* strays_ = nullptr;
};

}  // namespace selvage
