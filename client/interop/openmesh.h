// SPDX-License-Identifier: MIT
//
// The door to OpenMesh for programs that use the client library. A stitched mesh goes in as it is:
//
//     Result<OpenMeshTriMesh> mesh = to_openmesh(stitched);
//     if (!mesh) ...               // not manifold: the message names the first triangle that does not fit
//     for (auto v : mesh->vertices()) ... mesh->point(v) ...
//     TriangleSoup edited = from_openmesh(*mesh);
//
// Handles are the stitched mesh's indices, so region labels and other per-vertex data can be looked up by
// `v.idx()`. The functions live in common/mesh_io, where the OM file format needs them too; link
// `selvage_openmesh`.
#pragma once

#include "common/mesh_io/openmesh_mesh.h"
