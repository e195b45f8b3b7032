// SPDX-License-Identifier: MIT
//
// The height field of XMR-G mode: one number a vertex instead of curvature and distance with a threshold
// each.
//   kappa = radius times least normal curvature, dimensionless;
// kappa < 0 exactly where the surface is hyperbolic or concave, the dissertation's Def. 4.3 in one number.
// The radius belongs to the shape and not to the sampling, so resolution hardly matters.
#pragma once

#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/components.h"
#include "server/segment/neighbours.h"
#include "server/segment/vertex_measures.h"

namespace selvage {

struct HeightFieldOptions {
  double radius_share = 0.04;  ///< rho: radius as a share of the square root of the component's area
  /// Distance between samples as a share of the radius, in whole edges; 0: every vertex. Half as
  /// dense costs .001 of Rand error on the benchmark, twice as dense gains nothing.
  double sample_spacing = 0.34;
  /// Sharp convex edges separate too: kappa becomes min(kappa, -0.5 * greatest bending). For CAD parts.
  bool cut_at_ridges = false;
};

/// By vertex.
struct HeightField {
  std::vector<float> kappa;   ///< dimensionless, 0 at border vertices
  std::vector<float> radius;  ///< model units: max(rho sqrt(component area), 1.5 mean edge length)
};

/// Measures bending at samples, in parallel, and spreads it to all vertices.
HeightField measure_height(const CornerTable& mesh, const Neighbours& neighbours,
                           std::span<const Vec3> positions, const Components& components,
                           std::span<const ComponentShape> shapes, const VertexMeasures& measures,
                           const HeightFieldOptions& options, const ParallelFor& parallel);

}  // namespace selvage
