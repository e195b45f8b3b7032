// SPDX-License-Identifier: MIT
#pragma once

#include "common/mesh/triangle_soup.h"

namespace selvage::bench {

/// "A Simple, Fast, and Effective Polygon Reduction Algorithm" [Melax 1998], PR of the dissertation's Table
/// 3.1, from its formula: u goes to the neighbour v of least
///
///   cost(u, v) = |u - v| * max over f in T(u) of min over n in T(uv) of (1 - f.normal . n.normal) / 2
///
/// with T(u) the triangles at u and T(uv) those of them at v. Like the original it checks nothing else, so
/// the result need not be a manifold.
TriangleSoup melax_reduce(const TriangleSoup& soup, std::size_t target_triangles);

}  // namespace selvage::bench
