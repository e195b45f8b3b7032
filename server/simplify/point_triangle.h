// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "common/mesh/vec3.h"

namespace selvage {

/// A triangle made ready to be asked for distances many times. May be degenerate.
struct PreparedTriangle {
  PreparedTriangle(const Vec3& a_, const Vec3& b, const Vec3& c)
      : a(a_),
        ab(b - a_),
        ac(c - a_),
        normal(cross(ab, ac)),
        ab_ab(dot(ab, ab)),
        ab_ac(dot(ab, ac)),
        ac_ac(dot(ac, ac)),
        normal_normal(dot(normal, normal)) {}

  /// Squared distance from `p` to the nearest point of the triangle, by the region of the triangle's plane
  /// that p is over [Ericson 2005, section 5.1.5].
  double squared_distance(const Vec3& p) const {
    const Vec3 ap = p - a;
    const double ap_ap = dot(ap, ap);
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return ap_ap;
    const double d3 = d1 - ab_ab, d4 = d2 - ab_ac;
    if (d3 >= 0 && d4 <= d3) return from_corner(p - (a + ab));
    if (d1 * d4 - d3 * d2 <= 0 && d1 >= 0 && d3 <= 0 && ab_ab > 0)
      return std::max(0.0, ap_ap - d1 * d1 / ab_ab);
    const double d5 = d1 - ab_ac, d6 = d2 - ac_ac;
    if (d6 >= 0 && d5 <= d6) return from_corner(p - (a + ac));
    if (d5 * d2 - d1 * d6 <= 0 && d2 >= 0 && d6 <= 0 && ac_ac > 0)
      return std::max(0.0, ap_ap - d2 * d2 / ac_ac);
    if (d3 * d6 - d5 * d4 <= 0 && d4 >= d3 && d5 >= d6) {
      const Vec3 bp = ap - ab;
      const double along = d4 - d3;
      return std::max(0.0, dot(bp, bp) - along * along / (along + (d5 - d6)));
    }
    const double height = dot(normal, ap);
    return normal_normal > 0 ? height * height / normal_normal : ap_ap;
  }

  Vec3 a, ab, ac, normal;
  double ab_ab, ab_ac, ac_ac, normal_normal;

 private:
  static double from_corner(const Vec3& d) { return dot(d, d); }
};

}  // namespace selvage
