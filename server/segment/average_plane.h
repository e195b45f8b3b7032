// SPDX-License-Identifier: MIT
//
// Concaveness, dissertation section 4.1.2: on which side of the average plane of its neighbourhood a vertex
// lies. It closes the gaps that Gaussian curvature leaves at concave corners, which are elliptic (Fig. 4.3).
#pragma once

#include <span>

#include "common/mesh/vec3.h"
#include "server/segment/rings.h"

namespace selvage {

/// Eq. 4.4 and 4.5: the area-weighted mean normal and mean centre of the faces (v, ring[i], ring[i+1]).
/// The text does not say what v_i in 4.5 is; here it is the face's centroid.
struct AveragePlane {
  Vec3 normal;  ///< not of unit length: shorter the less the faces agree, zero where they have no area
  Vec3 centre;
};

AveragePlane average_plane(std::span<const Vec3> positions, VertexId v, const Ring& ring);

/// Eq. 4.7: the signed distance d_s of v from its average plane, in model units. Negative: concave, otherwise
/// convex (eq. 4.8), if the surface is oriented outwards.
double signed_distance(std::span<const Vec3> positions, VertexId v, const Ring& ring);

}  // namespace selvage
