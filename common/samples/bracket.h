// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/triangle_soup.h"
#include "common/samples/cad_builder.h"

namespace selvage {

/// An angle bracket as a CAD program exports it: two plates with rounded corners, a rib, six bolt holes, and
/// a chamfered boss with a bore. Millimetres, y is up, the base plate lies on y = 0. Closed, genus 7.
TriangleSoup make_bracket(std::uint32_t about_triangles);

/// Where bolts go through the bracket: on the plate's face, w pointing out of it, and how far it is through.
struct BoltHole {
  Frame frame;
  double radius, depth;
};
std::vector<BoltHole> bracket_bolt_holes();

}  // namespace selvage
