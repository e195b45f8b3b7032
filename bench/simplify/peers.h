// SPDX-License-Identifier: MIT
//
// The simplifiers that ours is measured against, each with the mesh already in its own form: building that is
// not counted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/triangle_soup.h"

namespace selvage::bench {

/// A manifold mesh as repair leaves it.
struct BenchMesh {
  std::string name;
  CornerTable table;
  TriangleSoup soup;  ///< the same triangles and positions
};

struct Outcome {
  TriangleSoup soup;
  double seconds = 0;             ///< CPU
  std::size_t working_bytes = 0;  ///< most in use at a time, beyond what there was when it began
};

struct Simplifier {
  std::string name;
  std::function<Outcome(const BenchMesh&, std::size_t target_triangles)> run;
};

/// "md" (ours, first), "ea", "qem", "meshopt", "openmesh", "melax", and "cgal" where it is built in.
std::vector<Simplifier> all_simplifiers();

}  // namespace selvage::bench
