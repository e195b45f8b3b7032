// SPDX-License-Identifier: MIT
#pragma once

#include "common/mesh/triangle_soup.h"
#include "common/samples/solid.h"

namespace selvage {

/// Spreads the vertices of a closed mesh evenly over the surface of the solid that it was made from: a few
/// rounds of moving each towards the middle of its neighbours and back onto the surface, with edge flips in
/// between.
void relax_on_surface(TriangleSoup& soup, Solid solid);

}  // namespace selvage
