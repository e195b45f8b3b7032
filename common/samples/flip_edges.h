// SPDX-License-Identifier: MIT
#pragma once

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// Flips edges until, as far as that can be, the two angles that face an edge are together no more than 180
/// degrees (Delaunay, in a plane). Border edges stay, and so do edges whose flip would fold or crease the
/// surface or join vertices that have an edge already. The soup must be an oriented manifold with boundary.
void flip_to_delaunay(TriangleSoup& soup);

}  // namespace selvage
