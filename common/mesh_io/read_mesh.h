// SPDX-License-Identifier: MIT
//
// The one way in for meshes: a path in, the file's own triangles out, or an error that names the file, the
// line or byte, and what to do about it. Formats: PLY, OBJ, OFF, STL, WRL (VRML97), OM (through OpenMesh).
#pragma once

#include <filesystem>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Reads the whole file into memory first. The extension names the format; content that is plainly another's
/// is refused, so that a renamed file does not end in a puzzling message. Errors begin with the path.
Result<MeshFile> read_mesh(const std::filesystem::path& path);

/// Whether the extension, in any case, is one that read_mesh takes: .ply .obj .off .stl .wrl .om
bool is_mesh_file_name(const std::filesystem::path& path);

}  // namespace selvage
