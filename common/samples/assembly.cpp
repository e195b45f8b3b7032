// SPDX-License-Identifier: MIT
#include "common/samples/assembly.h"

#include <algorithm>

#include "common/samples/bracket.h"
#include "common/samples/fasteners.h"

namespace selvage {
namespace {

void append(TriangleSoup& to, const TriangleSoup& part) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& [a, b, c] : part.triangles) to.triangles.push_back({base + a, base + b, base + c});
}

}  // namespace

TriangleSoup make_assembly(std::uint32_t about_triangles) {
  TriangleSoup soup = make_bracket(about_triangles / 3);
  // A bolt, washer and nut have about 30 triangles to a point on a circle.
  const int around = std::clamp(static_cast<int>(about_triangles / 3 * 2 / (6 * 30)), 12, 384) / 6 * 6;
  constexpr double kGap = 0.05;  // parts touch in no point, as machining tolerances leave them
  for (const BoltHole& hole : bracket_bolt_holes()) {
    const double radius = 0.92 * hole.radius, washer = 0.35 * radius;
    const Frame& face = hole.frame;
    Frame head = face, below = face, under = face;
    below.origin = face.at(0, 0, kGap);
    head.origin = face.at(0, 0, washer + 2 * kGap);
    under = {face.at(0, 0, -hole.depth - kGap), face.v, face.u, -face.w};
    append(soup, make_washer(below, radius, washer, around));
    append(soup, make_bolt(head, radius, hole.depth + 3.2 * radius, around));
    append(soup, make_nut(under, radius, around));
  }
  return soup;
}

}  // namespace selvage
