// SPDX-License-Identifier: MIT
//
// Discrete Gaussian curvature, dissertation section 4.1.1.
#pragma once

#include <span>

#include "common/mesh/vec3.h"
#include "server/segment/rings.h"

namespace selvage {

/// The angle at `apex` between the directions to `a` and `b`, in radians, 0 where either has no length.
double angle_at(const Vec3& apex, const Vec3& a, const Vec3& b);

/// Eq. 4.1, the integral of the Gaussian curvature over the area that belongs to v: 2 pi minus the angles at
/// v of the faces (v, ring[i], ring[i+1]), in radians. Positive: elliptic; negative: hyperbolic; 0 at a
/// border vertex, where the deficit says nothing about the surface.
double angle_deficit(std::span<const Vec3> positions, VertexId v, const Ring& ring);

/// Eq. 4.2, the mean Gaussian curvature of that area: 3 * deficit / area of the faces, in 1 / (model unit
/// squared). 0 where the faces have no area.
double gaussian_curvature(std::span<const Vec3> positions, VertexId v, const Ring& ring);

}  // namespace selvage
