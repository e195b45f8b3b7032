// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// A shape to be cut into patches by cubes of side `cell`, each patch a region.
struct LabelledShape {
  std::string name;
  TriangleSoup soup;
  double cell;
};

/// Shapes for tests of levels: closed, with borders and holes, of higher genus, in several pieces, thin;
/// their triangles are oriented manifolds by shared indices.
std::vector<LabelledShape> labelled_shapes();

}  // namespace selvage
