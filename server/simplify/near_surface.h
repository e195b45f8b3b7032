// SPDX-License-Identifier: MIT
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

/// A surface to look for near triangles in: they, what lies beyond their edges, and a tree of boxes over
/// them in their order, which is cheap to build and as good as the order is (see spatially_ordered).
/// Immutable, so threads may share it. All spans are borrowed.
class NearSurface {
 public:
  /// `triangles` must not be empty. `opposite` is as in CornerTable, or empty: nothing is known to be
  /// adjacent then. `region_of_vertex` may be empty if `nearest` is never asked for one region.
  NearSurface(std::span<const Triangle> triangles, std::span<const Vec3> positions,
              std::span<const CornerId> opposite = {}, std::span<const RegionId> region_of_vertex = {});

  struct Near {
    std::uint32_t triangle;
    double squared_distance;
  };
  /// A node still to be looked into, and how far its box is, squared.
  struct Open {
    std::uint32_t node;
    double squared_distance;
  };
  /// The triangle nearest to p among those nearer than `nearer_than`, squared; kNone if there is none. With
  /// `only`, among those inside that region. `stack` is scratch.
  Near nearest(const Vec3& p, double nearer_than, std::vector<Open>& stack, RegionId only = kNone) const;

  PreparedTriangle prepared(std::uint32_t i) const {
    const auto [a, b, c] = triangles_[i];
    return {positions_[a], positions_[b], positions_[c]};
  }
  const Triangle& triangle(std::uint32_t i) const { return triangles_[i]; }

  /// The triangle beyond the edge that corner `side` of triangle `i` faces, kNone if there is none.
  std::uint32_t across(std::uint32_t i, std::uint32_t side) const {
    if (opposite_.empty()) return kNone;
    const CornerId c = opposite_[3 * i + side];
    return c == kNone ? kNone : c / 3;
  }

  /// The region that has all three corners, kNone if they are in several.
  RegionId region_of(std::uint32_t i) const {
    const auto [a, b, c] = triangles_[i];
    const RegionId region = region_of_vertex_[a];
    return region_of_vertex_[b] == region && region_of_vertex_[c] == region ? region : kNone;
  }

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
  std::span<const CornerId> opposite_;
  std::span<const RegionId> region_of_vertex_;
  std::uint32_t leaves_ = 1;  // a power of two
  std::vector<Box> boxes_;    // of node n: children 2n and 2n + 1; leaves from leaves_ on
};

}  // namespace selvage
