// SPDX-License-Identifier: MIT
//
// Turned shapes with parts that anyone would name the same way, for segmentation tests. Closed, oriented
// outwards.
#pragma once

#include <span>

#include "common/mesh/triangle_soup.h"

namespace selvage::shapes {

/// A point of a profile: distance from the z axis, and height.
struct ProfilePoint {
  double radius, z;
};

/// Turns a profile about the z axis. Straight pieces are sampled every `step`, rings have about 2 pi r / step
/// vertices at the widest point. The profile starts and ends on the axis (radius 0) and runs upwards.
TriangleSoup lathe(std::span<const ProfilePoint> profile, double step);

TriangleSoup capped_cylinder(double step);  ///< one part
TriangleSoup bolt(double step);             ///< wide head, long body: two coaxial cylinders
TriangleSoup dumbbell(double step);         ///< two balls and a bar
TriangleSoup bottle(double step);           ///< body, neck, flared lip; smooth

TriangleSoup inside_out(TriangleSoup soup);
/// Two coincident triangles glued along all three edges: closed, every vertex of valence two.
TriangleSoup pillow();

}  // namespace selvage::shapes
