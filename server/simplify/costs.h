// SPDX-License-Identifier: MIT
//
// What a collapse costs, as a function of the star of the vertex that goes. Quadrics, which remember earlier
// collapses, are in quadrics.h.
//
// `mean_area` is the mean triangle area of the input, in squared units: it makes costs independent of the
// unit of length up to a common factor. The star has triangles with area.
#pragma once

#include <cstdint>

#include "server/simplify/star.h"

namespace selvage {

/// (A / 6 mean_area)^(1/4) with A the area of the star: what weighs a deviation in a large star more than the
/// same one in a small star, so that the resolution adapts slowly to curvature.
double star_weight(const Star& star, double mean_area);

/// Memoryless plane distance, squared units: the mean over the star, by area, of the squared distance from
/// the target to the triangle's plane, plus at the border the squared distance of the centre from the new
/// border edge; times the star's weight. It keeps no history [Lindstrom and Turk 1998]; the deviation
/// (removed_points.h) takes care of what adds up.
double plane_distance_cost(const Star& star, std::uint32_t place, double mean_area);

/// The dissertation's EA, eq. 3.6: E_C + E_A / mean_area.
///   E_C  edge curvature, eq. 3.4: l (1 - n1.n2) / (h1 + h2), no unit; 0 at a border edge, which has one
///   normal
///   E_A  area change, eq. 3.5: (sum of areas before - sum after)^2 / sum before, squared units
/// As printed E_A is not divided by anything, and a model in millimetres would simplify unlike the same one
/// in metres. E_inf of eq. 3.8 is legality.h's keeps_convexity.
double edge_area_cost(const Star& star, std::uint32_t place, double mean_area);

}  // namespace selvage
