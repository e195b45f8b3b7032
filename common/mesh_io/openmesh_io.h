// SPDX-License-Identifier: MIT
//
// OM, OpenMesh's own binary format, read and written by OpenMesh. The format stores a half-edge structure.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input: the file's structure is checked before OpenMesh sees it (its reader asserts), and
/// the reader drives a recorder of ours instead of a mesh, so that every index is checked before it is
/// followed and the file's own vertices and faces come out. The counts that it delivers are compared with the
/// file's. Files of a version before 2, custom properties and status flags are refused as Unsupported;
/// normals, colours and texture coordinates are dropped with a note. Thread-safe: a mutex guards OpenMesh's
/// one reader.
Result<MeshFile> parse_om(std::span<const std::byte> bytes);

/// The mesh as an OM file with float64 positions. InvalidArgument where a half-edge mesh cannot hold it (see
/// openmesh_mesh.h).
Result<std::string> format_om(const TriangleSoup& soup);

}  // namespace selvage
