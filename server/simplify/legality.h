// SPDX-License-Identifier: MIT
//
// Which collapses leave an oriented manifold an oriented manifold, and a surface unfolded. Geometry and
// connectivity are asked apart: the former depends on the star alone, the latter also on the other vertex's.
#pragma once

#include <cstdint>

#include "common/mesh/corner_table.h"
#include "server/simplify/stamps.h"
#include "server/simplify/star.h"

namespace selvage {

/// The link condition [Dey et al. 1999]: the centre and the vertex at `place` have no common neighbour but
/// the third vertices of the triangles at their edge, and none of those would lose its surface: an interior
/// one has more than three triangles, one on the border more than one. The centre keeps a triangle to hand
/// on. Edges that share both vertices without being one (cut non-manifold edges) count as they should: no
/// collapse makes a second edge between two vertices. `stamps` is scratch memory, an element a vertex.
bool keeps_manifold(const CornerTable& mesh, const Star& star, std::uint32_t place, Stamps& stamps);

/// No triangle that is left turns by 78 degrees or more (n'.n > 0.2 |n'||n|) or loses its area
/// (|n'| > 1e-7 times the sum of |n|). A triangle that has no area to begin with is held against the mean
/// normal of the star.
bool keeps_normals(const Star& star, std::uint32_t place);

/// The dissertation's tests, section 3.2.3.3: no triangle that is left has area zero (Fig. 3.9), and the ring
/// is convex at both neighbours of the target (Def. 3.2, eq. 3.7).
bool keeps_convexity(const Star& star, std::uint32_t place);

}  // namespace selvage
