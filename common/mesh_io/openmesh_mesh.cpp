// SPDX-License-Identifier: MIT
#include "common/mesh_io/openmesh_mesh.h"

#include <array>
#include <vector>

#include "common/base/ids.h"

namespace selvage {
namespace {

using Handles = std::array<OpenMesh::VertexHandle, 3>;

/// Why the mesh so far cannot take this triangle; nullptr when it can. Asked first because OpenMesh itself
/// says it on stderr.
const char* reason_to_refuse(const OpenMeshTriMesh& mesh, const Handles& corners) {
  for (int i = 0; i < 3; ++i) {
    const OpenMesh::VertexHandle from = corners[i], to = corners[(i + 1) % 3];
    if (from == to) return "it has a repeated vertex";
    const OpenMesh::HalfedgeHandle edge = mesh.find_halfedge(from, to);
    if (edge.is_valid() && !mesh.is_boundary(edge)) {
      return "another triangle walks one of its edges the same way (flipped or non-manifold)";
    }
    if (!mesh.is_boundary(from))
      return "one of its vertices is already surrounded by triangles (non-manifold)";
  }
  return nullptr;
}

}  // namespace

Result<OpenMeshTriMesh> to_openmesh(const TriangleSoup& soup) {
  OpenMeshTriMesh mesh;
  mesh.reserve(soup.positions.size(), soup.positions.size() + soup.triangles.size(), soup.triangles.size());
  for (const Vec3& p : soup.positions) mesh.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Handles corners = {mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c)};
    const char* reason = reason_to_refuse(mesh, corners);
    if (!reason && mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) continue;
    return fail(ErrorCode::InvalidArgument,
                "OpenMesh cannot hold triangle " + std::to_string(t) + ": " +
                    (reason ? reason : "its fans cannot be linked (non-manifold)"));
  }
  return mesh;
}

TriangleSoup from_openmesh(const OpenMeshTriMesh& mesh) {
  TriangleSoup soup;
  std::vector<std::uint32_t> index_of_handle(mesh.n_vertices(), kNone);
  for (const OpenMesh::VertexHandle v : mesh.vertices()) {
    index_of_handle[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(soup.positions.size());
    const OpenMesh::Vec3d& p = mesh.point(v);
    soup.positions.push_back({p[0], p[1], p[2]});
  }
  for (const OpenMesh::FaceHandle f : mesh.faces()) {
    Triangle triangle{};
    int corner = 0;
    for (const OpenMesh::VertexHandle v : mesh.fv_range(f)) {
      triangle[corner++] = index_of_handle[static_cast<std::size_t>(v.idx())];
    }
    soup.triangles.push_back(triangle);
  }
  return soup;
}

}  // namespace selvage
