// SPDX-License-Identifier: MIT
#pragma once

#include "common/mesh/triangle_soup.h"
#include "common/samples/cad_builder.h"

namespace selvage {

/// Standard parts that stand on the frame's u-v plane. `radius` is that of the bolt's shank, `around` the
/// points on a circle, a multiple of 6.

/// A ring of the given thickness, genus 1.
TriangleSoup make_washer(const Frame& frame, double radius, double thickness, int around);

/// A hexagonal head on the plane and a shank of `shank` below it, its end chamfered.
TriangleSoup make_bolt(const Frame& frame, double radius, double shank, int around);

/// A hexagonal nut, chamfered on top, genus 1.
TriangleSoup make_nut(const Frame& frame, double radius, int around);

}  // namespace selvage
