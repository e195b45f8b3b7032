// SPDX-License-Identifier: MIT
//
// Between a triangle soup and an OpenMesh mesh, without loss or an error. OpenMesh's own importers split
// vertices where the mesh is not manifold and skip faces with a repeated vertex; what cannot be held as it
// is, is refused here. Include this only where OpenMesh may be used: common/mesh_io/openmesh_io.cpp and
// client/interop.
#pragma once

#include <string>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "common/base/result.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

struct OpenMeshDoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// OpenMesh's triangle mesh with float64 positions; no attributes requested.
class OpenMeshTriMesh : public OpenMesh::TriMesh_ArrayKernelT<OpenMeshDoubleTraits> {};

/// Vertex and face handles are the soup's indices. Refuses (InvalidArgument, naming the triangle) what a
/// half-edge mesh cannot hold: an edge of more than two triangles, two triangles that walk an edge the same
/// way, a closed fan of triangles at a vertex with something else attached, a triangle with a repeated
/// vertex. Several open fans at one vertex are kept.
Result<OpenMeshTriMesh> to_openmesh(const TriangleSoup& soup);

/// The live elements in order; vertices and faces that are only marked as deleted are left out and the rest
/// renumbered.
TriangleSoup from_openmesh(const OpenMeshTriMesh& mesh);

}  // namespace selvage
