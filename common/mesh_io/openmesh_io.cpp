// SPDX-License-Identifier: MIT
#include "common/mesh_io/openmesh_io.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/IO/reader/OMReader.hh>
#include <OpenMesh/Core/IO/writer/OMWriter.hh>

#include "common/base/ids.h"
#include "common/coding/byte_io.h"
#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/openmesh_mesh.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

/// OpenMesh's readers and writers keep their state in global objects.
std::mutex& openmesh_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// 'O' 'M' | u8 kind: T, Q or P | u8 version | u32 vertices | u32 faces | u32 edges
struct OmHeader {
  char kind = 0;
  std::uint32_t vertices = 0, faces = 0, edges = 0;
};

Result<OmHeader> read_om_header(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  OmHeader header;
  if (in.u8() != 'O' || in.u8() != 'M')
    return fail(ErrorCode::BadFile, "not an OM file: it does not begin with 'OM'", 0);
  header.kind = static_cast<char>(in.u8());
  in.u8();
  header.vertices = in.u32();
  header.faces = in.u32();
  header.edges = in.u32();
  if (!in.ok()) return fail(ErrorCode::BadFile, "the OM header is cut short", bytes.size());
  if (header.kind != 'T' && header.kind != 'P') {
    return fail(ErrorCode::Unsupported, "an OM file that is neither a triangle nor a polygon mesh", 2);
  }
  // At least 12 bytes a vertex, 1 a face, 6 an edge.
  if (header.vertices > in.left() / 12 || header.faces > in.left() || header.edges > in.left() / 6) {
    return fail(ErrorCode::BadFile,
                "the OM header declares " + std::to_string(header.vertices) + " vertices, " +
                    std::to_string(header.faces) + " faces and " + std::to_string(header.edges) +
                    " edges, more than the rest of the file can hold; is it cut short?",
                4);
  }
  return header;
}

/// Takes what OpenMesh's reader finds, as numbers; follows none of them. The mesh behind it stays empty: it
/// answers questions about attributes (there are none). Throws length_error when the reader goes on after the
/// end of a file.
class Recorder final : public OpenMesh::IO::ImporterT<OpenMeshTriMesh> {
 public:
  using Base = OpenMesh::IO::ImporterT<OpenMeshTriMesh>;
  using Base::set_face_texindex;

  struct Halfedge {
    std::uint32_t to_vertex = kNone, face = kNone, next = kNone;
  };

  Recorder(OpenMeshTriMesh& empty, const OmHeader& header, std::size_t most_corners)
      : Base(empty), header_(header), most_corners_(most_corners) {}

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& p) override {
    if (positions.size() == header_.vertices) throw std::length_error("vertices");
    positions.push_back({p[0], p[1], p[2]});
    return OpenMesh::VertexHandle(static_cast<int>(positions.size() - 1));
  }
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& p) override {
    return add_vertex(OpenMesh::Vec3d(p[0], p[1], p[2]));
  }
  OpenMesh::VertexHandle add_vertex() override { return add_vertex(OpenMesh::Vec3d(0, 0, 0)); }
  void set_point(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_halfedge(OpenMesh::VertexHandle, OpenMesh::HalfedgeHandle) override {}

  OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle from, OpenMesh::VertexHandle to) override {
    if (halfedges.size() == 2 * std::size_t{header_.edges}) throw std::length_error("edges");
    halfedges.push_back({number(to)});
    halfedges.push_back({number(from)});
    return OpenMesh::HalfedgeHandle(static_cast<int>(halfedges.size() - 2));
  }
  void set_next(OpenMesh::HalfedgeHandle h, OpenMesh::HalfedgeHandle next) override {
    if (number(h) < halfedges.size()) halfedges[number(h)].next = number(next);
  }
  void set_face(OpenMesh::HalfedgeHandle h, OpenMesh::FaceHandle f) override {
    if (number(h) < halfedges.size()) halfedges[number(h)].face = number(f);
  }

  OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle first) override {
    if (halfedge_of_face.size() == header_.faces) throw std::length_error("faces");
    halfedge_of_face.push_back(number(first));
    return OpenMesh::FaceHandle(static_cast<int>(halfedge_of_face.size() - 1));
  }
  OpenMesh::FaceHandle add_face(const VHandles& corners) override {  // files before version 2
    if (polygons.size() == header_.faces || corners.size() > most_corners_) throw std::length_error("faces");
    most_corners_ -= corners.size();
    std::vector<std::uint32_t>& polygon = polygons.emplace_back();
    for (const OpenMesh::VertexHandle v : corners) polygon.push_back(number(v));
    return OpenMesh::FaceHandle(static_cast<int>(polygons.size() - 1));
  }

  std::size_t n_vertices() const override { return positions.size(); }
  std::size_t n_faces() const override { return halfedge_of_face.size() + polygons.size(); }
  std::size_t n_edges() const override { return halfedges.size() / 2; }

  std::vector<Vec3> positions;
  std::vector<Halfedge> halfedges;
  std::vector<std::uint32_t> halfedge_of_face;
  std::vector<std::vector<std::uint32_t>> polygons;

 private:
  template <class Handle>
  static std::uint32_t number(Handle handle) {
    return static_cast<std::uint32_t>(handle.idx());  // -1, "none", becomes kNone
  }

  OmHeader header_;
  std::size_t most_corners_;
};

/// Whether OpenMesh liked the file and read to its end, but not beyond.
bool record(std::span<const std::byte> bytes, Recorder& recorder) {
  const std::lock_guard lock(openmesh_mutex());
  std::istringstream in{std::string(as_text(bytes))};
  OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
  try {
    return OpenMesh::IO::OMReader().read(in, recorder, options) && !in.fail();
  } catch (const std::length_error&) {
    return false;
  }
}

/// Goes round each face once. Every half-edge is marked when passed, so a file that crosses its rings ends in
/// false.
bool follow_faces(Recorder& from) {
  std::vector<bool> is_passed(from.halfedges.size());
  for (std::uint32_t f = 0; f < from.halfedge_of_face.size(); ++f) {
    std::vector<std::uint32_t>& polygon = from.polygons.emplace_back();
    const std::uint32_t first = from.halfedge_of_face[f];
    std::uint32_t h = first;
    do {
      if (h >= from.halfedges.size() || is_passed[h] || from.halfedges[h].face != f) return false;
      is_passed[h] = true;
      polygon.push_back(from.halfedges[h].to_vertex);
      h = from.halfedges[h].next;
    } while (h != first);
  }
  return true;
}

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

Result<MeshFile> parse_om(std::span<const std::byte> bytes) {
  const Result<OmHeader> header = read_om_header(bytes);
  if (!header) return tl::unexpected(header.error());
  OpenMeshTriMesh empty;
  Recorder found(empty, *header, bytes.size());
  if (!record(bytes, found))
    return fail(ErrorCode::BadFile, "OpenMesh cannot read this OM file; is it cut short?");
  if (found.positions.size() != header->vertices || found.n_faces() != header->faces) {
    return fail(ErrorCode::BadFile,
                "the OM header declares " + std::to_string(header->vertices) + " vertices and " +
                    std::to_string(header->faces) + " faces, but OpenMesh found " +
                    std::to_string(found.positions.size()) + " and " + std::to_string(found.n_faces()));
  }
  if (!follow_faces(found))
    return fail(ErrorCode::BadFile, "the half-edges of this OM file do not make up its faces");
  MeshBuilder mesh;
  for (std::size_t v = 0; v < found.positions.size(); ++v) {
    if (!is_finite(found.positions[v])) {
      return fail(ErrorCode::BadFile,
                  "a coordinate of vertex " + std::to_string(v) + " is not a finite number");
    }
    mesh.add_vertex(found.positions[v]);
  }
  for (const std::vector<std::uint32_t>& polygon : found.polygons) {
    for (std::uint32_t v : polygon) {
      if (v < found.positions.size()) continue;
      return fail(ErrorCode::BadFile, "a face names vertex " + std::to_string(v) +
                                          ", but the file has only " +
                                          std::to_string(found.positions.size()));
    }
    mesh.add_polygon(polygon);
  }
  return std::move(mesh).finish("OM");
}

Result<std::string> format_om(const TriangleSoup& soup) {
  Result<OpenMeshTriMesh> mesh = to_openmesh(soup);
  if (!mesh) return forward_error(mesh);
  OpenMesh::IO::ExporterT<OpenMeshTriMesh> exporter(*mesh);
  std::ostringstream out;
  const std::lock_guard lock(openmesh_mutex());
  if (!OpenMesh::IO::OMWriter().write(out, exporter, OpenMesh::IO::Options::Binary)) {
    return fail(ErrorCode::Io, "OpenMesh could not write the mesh");
  }
  return std::move(out).str();
}

}  // namespace selvage
