// SPDX-License-Identifier: MIT
//
// Distances between two surfaces as Metro takes them [Cignoni et al. 1998]: samples on each, nearest points
// on the other.
#pragma once

#include "common/mesh/triangle_soup.h"

namespace selvage::bench {

struct SurfaceDistance {
  double largest = 0;  ///< two-sided Hausdorff distance, from the samples
  double mean = 0;     ///< the larger of the two mean distances
};

/// In model units. Samples are all vertices, and points on edges and faces at a spacing that gives about
/// `samples` on each surface. Triangles may be degenerate.
SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b, std::size_t samples = 200000);

/// Of the bounding box, model units.
double diagonal_of(const TriangleSoup& soup);

}  // namespace selvage::bench
