// SPDX-License-Identifier: MIT
//
// The one way out for meshes. The extension names the format:
//
//   .ply  binary little-endian, `property double` x y z: exact
//   .obj  .off  text, each number the shortest that reads back as the same double: exact
//   .stl  binary; the format holds float32 and no indices, so positions are rounded and unreferenced vertices
//   lost .om   through OpenMesh, float64: exact, but refused where the mesh is not manifold (see
//   openmesh_mesh.h)
#pragma once

#include <filesystem>
#include <string>

#include "common/base/result.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

struct WriteOptions {
  std::string comment;  ///< goes into the file where the format has comments (.ply .obj .off; the first 79
                        ///< bytes in .stl)
};

/// What write_mesh would fail at whatever the mesh: an extension that it does not know, a folder that is not
/// there or cannot be written to. For asking before hours of work.
Result<void> check_writable(const std::filesystem::path& path);

/// Whole or not at all: a failure, such as a full disk, leaves the file that was there. Errors begin with the
/// path.
Result<void> write_mesh(const std::filesystem::path& path, const TriangleSoup& soup,
                        const WriteOptions& options = {});

}  // namespace selvage
