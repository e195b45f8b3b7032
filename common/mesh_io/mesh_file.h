// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// What a mesh file says, and what of it was left behind.
struct MeshFile {
  /// The file's own vertex indices and order. Polygons are fan-triangulated from their first corner, where
  /// they stood. Unreferenced vertices and triangles with a repeated index are still here: repair reports
  /// them.
  TriangleSoup soup;
  std::string format;              ///< for people: "PLY binary little-endian", "OBJ" ...
  std::uint32_t polygons = 0;      ///< faces in the file that had more than three corners
  std::vector<std::string> notes;  ///< a line each for stderr: attributes dropped, polygons triangulated ...
};

}  // namespace selvage
