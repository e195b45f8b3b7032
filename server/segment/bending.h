// SPDX-License-Identifier: MIT
//
// How a surface bends around a vertex, seen over a radius instead of a number of rings: the XMR idea
// (dissertation Def. 4.4) made independent of the sampling.
#pragma once

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/geodesic.h"

namespace selvage {

/// Radius times normal curvature, dimensionless; convex is positive. A sphere of radius R has mean r / R.
struct Bending {
  double mean = 0;       ///< over all directions
  double amplitude = 0;  ///< least = mean - amplitude, greatest = mean + amplitude

  double least() const { return mean - amplitude; }
  double greatest() const { return mean + amplitude; }
};

/// Shoots eight geodesics of length `radius` from `v`, at equal angles. With d_j the way to the j-th end,
/// rho_j the length walked and N the normal of the fan of ends, the bending in that direction is
///   q_j = -2 radius (d_j . N) / rho_j^2,
/// and mean and amplitude are the 0th and 2nd Fourier coefficients of q (Euler's formula for normal
/// curvature). A direction that meets a mesh border before 0.3 radius takes the value of the opposite one, or
/// 0. `outward` is -1 on a surface that faces inwards. Zero at border vertices. Needs a triangle at `v`.
Bending measure_bending(const CornerTable& mesh, const GeodesicTracer& tracer, VertexId v, double radius,
                        double outward, GeodesicTracer::Scratch& scratch);

}  // namespace selvage
