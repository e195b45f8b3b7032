// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// What the author called some triangles. Numbers index `MeshFile::names`, so that a name repeated by
/// thousands of groups is stored once.
struct NamedGroup {
  std::vector<std::uint32_t> groups;  ///< OBJ `g`, which may state several
  std::uint32_t object = kNone;       ///< OBJ `o`
  std::uint32_t material = kNone;     ///< OBJ `usemtl`
};

/// What a mesh file says, and what of it was left behind.
struct MeshFile {
  /// The file's own vertex indices and order. Polygons are fan-triangulated from their first corner, where
  /// they stood. Unreferenced vertices and triangles with a repeated index are still here: repair reports
  /// them.
  TriangleSoup soup;
  /// By triangle, an index into `groups`; empty if the file names nothing. A file's groups are distinct.
  std::vector<std::uint32_t> group_of_triangle;
  std::vector<NamedGroup> groups;
  std::vector<std::string> names;
  std::string format;              ///< for people: "PLY binary little-endian", "OBJ" ...
  std::uint32_t polygons = 0;      ///< faces in the file that had more than three corners
  std::vector<std::string> notes;  ///< a line each for stderr: attributes dropped, polygons triangulated ...
};

}  // namespace selvage
