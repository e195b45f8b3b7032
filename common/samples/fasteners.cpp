// SPDX-License-Identifier: MIT
#include "common/samples/fasteners.h"

namespace selvage {
namespace {

// In shank radii, about as ISO 4014 and 4032 have them.
constexpr double kHexagon = 1.95, kHeadHeight = 1.4, kNutHeight = 1.7, kBevel = 0.16, kBevelRadius = 1.60;

Loop hexagon(const Frame& frame, double radius, double z) { return circle(frame, radius, z, 6); }

/// The upper side of a head or nut: the hexagon's own face, a bevel that rises from a circle in it, and the
/// flat inside.
void add_bevelled_top(CadBuilder& builder, const Frame& frame, double radius, double z,
                      const std::vector<Loop>& hole, int around) {
  const Loop foot = circle(frame, kBevelRadius * radius, z, around);
  const Loop rim = circle(frame, (kBevelRadius - kBevel) * radius, z + kBevel * radius, around);
  builder.face(frame.w, hexagon(frame, kHexagon * radius, z), std::vector<Loop>{foot});
  builder.wall(foot, rim);
  builder.face(frame.w, rim, hole);
}

}  // namespace

TriangleSoup make_washer(const Frame& frame, double radius, double thickness, int around) {
  CadBuilder builder;
  const Loop outer_low = circle(frame, 2.2 * radius, 0, around),
             outer_high = circle(frame, 2.2 * radius, thickness, around);
  const Loop inner_low = circle(frame, 1.08 * radius, 0, around),
             inner_high = circle(frame, 1.08 * radius, thickness, around);
  builder.wall(outer_low, outer_high);
  builder.wall(inner_high, inner_low);
  builder.face(frame.w, outer_high, std::vector<Loop>{inner_high});
  builder.face(-frame.w, outer_low, std::vector<Loop>{inner_low});
  return builder.take();
}

TriangleSoup make_bolt(const Frame& frame, double radius, double shank, int around) {
  CadBuilder builder;
  const double head = kHeadHeight * radius, chamfer = 0.2 * radius;
  const Loop neck = circle(frame, radius, 0, around),
             shoulder = circle(frame, radius, chamfer - shank, around);
  const Loop end = circle(frame, radius - chamfer, -shank, around);
  builder.wall(hexagon(frame, kHexagon * radius, 0), hexagon(frame, kHexagon * radius, head));
  add_bevelled_top(builder, frame, radius, head, {}, around);
  builder.face(-frame.w, hexagon(frame, kHexagon * radius, 0), std::vector<Loop>{neck});
  builder.wall(shoulder, neck);
  builder.wall(end, shoulder);
  builder.face(-frame.w, end);
  return builder.take();
}

TriangleSoup make_nut(const Frame& frame, double radius, int around) {
  CadBuilder builder;
  const double height = kNutHeight * radius, top = height + kBevel * radius, bore = 1.04 * radius;
  const Loop low = circle(frame, bore, 0, around), high = circle(frame, bore, top, around);
  builder.wall(hexagon(frame, kHexagon * radius, 0), hexagon(frame, kHexagon * radius, height));
  add_bevelled_top(builder, frame, radius, height, {high}, around);
  builder.face(-frame.w, hexagon(frame, kHexagon * radius, 0), std::vector<Loop>{low});
  builder.wall(high, low);
  return builder.take();
}

}  // namespace selvage
