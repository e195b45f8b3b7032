// SPDX-License-Identifier: MIT
#include "common/mesh_io/openmesh_io.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/IO/reader/OMReader.hh>
#include <OpenMesh/Core/IO/writer/OMWriter.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "common/base/ids.h"
#include "common/coding/byte_io.h"
#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/openmesh_mesh.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

/// While it lives, this thread has OpenMesh's readers and writers, which are global objects with state, to
/// itself, and OpenMesh prints nothing: what it has to say becomes an error, and "#bytes written" is nobody's
/// business.
class QuietOpenMesh {
 public:
  QuietOpenMesh() : lock_(mutex()) {
    omlog().disable();
    omerr().disable();
  }
  ~QuietOpenMesh() {
    omlog().enable();
    omerr().enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
};

/// 'O' 'M' | u8 kind: T, Q or P | u8 version: major in the top 3 bits | u32 vertices | u32 faces | u32 edges
/// | chunks
struct OmHeader {
  std::uint8_t version = 0;
  std::uint32_t vertices = 0, faces = 0, edges = 0;
};

enum Entity : unsigned { kVertex = 0, kFace = 2, kHalfedge = 6, kSentinel = 7 };
enum Content : unsigned { kPosition = 0, kNormal = 1, kTexcoord = 2, kColour = 4, kTopology = 7 };

/// The u16 before each chunk, from its lowest bit: reserved 1, named 1, entity 3, content 4, signed 1, float
/// 1, dimensions - 1 in 3, and the size of a number in 2.
struct ChunkHeader {
  explicit ChunkHeader(std::uint16_t bits)
      : is_named((bits >> 1 & 1) != 0),
        entity(bits >> 2 & 7u),
        content(bits >> 5 & 15u),
        dimensions((bits >> 11 & 7u) + 1),
        size_code(bits >> 14 & 3u) {}

  bool is_named;
  unsigned entity, content, dimensions, size_code;
};

Result<OmHeader> read_om_header(ByteReader& in) {
  OmHeader header;
  if (in.u8() != 'O' || in.u8() != 'M')
    return fail(ErrorCode::BadFile, "not an OM file: it does not begin with 'OM'", 0);
  const std::uint8_t kind = in.u8();
  header.version = in.u8();
  header.vertices = in.u32();
  header.faces = in.u32();
  header.edges = in.u32();
  if (!in.ok()) return fail(ErrorCode::BadFile, "the OM header is cut short");
  if (kind != 'T' && kind != 'P') {
    return fail(ErrorCode::Unsupported, "an OM file that is neither a triangle nor a polygon mesh", 2);
  }
  if (header.version >> 5 < 2) {
    return fail(ErrorCode::Unsupported,
                "an OM file of a version before 2; save it anew with a current OpenMesh", 3);
  }
  return header;
}

/// How many bytes OpenMesh's reader takes for a chunk's data; 0 for a kind that we do not let it see.
std::uint64_t chunk_bytes(const ChunkHeader& chunk, const OmHeader& header) {
  const std::uint64_t integer = std::uint64_t{1} << chunk.size_code;
  const std::uint64_t count = chunk.entity == kVertex ? header.vertices : header.faces;
  const bool is_element = chunk.entity == kVertex || chunk.entity == kFace;
  if (chunk.is_named || integer > 8) return 0;
  if (chunk.content == kTopology && chunk.entity == kHalfedge)
    return integer <= 4 ? 6 * integer * header.edges : 0;
  if (!is_element) return 0;
  if (chunk.content == kTopology) return integer <= 4 ? integer * count : 0;
  const bool is_vector = chunk.content == kNormal || (chunk.content == kPosition && chunk.entity == kVertex);
  if (is_vector && chunk.dimensions == 3 && chunk.size_code < 2)
    return 3 * (std::uint64_t{4} << chunk.size_code) * count;
  if (chunk.content == kColour && chunk.dimensions == 3 && chunk.size_code == 0) return 3 * count;
  if (chunk.content == kTexcoord && chunk.entity == kVertex && chunk.dimensions == 2 && chunk.size_code == 0)
    return 8 * count;
  return 0;
}

/// Steps through the chunks to the sentinel, which must be the file's last word. OpenMesh's reader asserts on
/// what it does not expect, which ends the program, and reads on over the end; after this it meets only what
/// it knows.
Result<OmHeader> check_chunks(std::span<const std::byte> bytes, MeshBuilder& mesh) {
  ByteReader in(bytes);
  const Result<OmHeader> header = read_om_header(in);
  if (!header) return header;
  bool has_attributes = false;
  for (;;) {
    const std::size_t offset = in.offset();
    const ChunkHeader chunk(in.u16());
    if (!in.ok()) return fail(ErrorCode::BadFile, "the OM file ends early; is it cut short?", bytes.size());
    if (chunk.entity == kSentinel) break;
    const std::uint64_t size = chunk_bytes(chunk, *header);
    if (size == 0) {
      return fail(ErrorCode::Unsupported,
                  "a part of the OM file that cannot be read (custom property, status ...); "
                  "save it with positions and faces only",
                  offset);
    }
    in.take(size);
    if (!in.ok()) {
      return fail(ErrorCode::BadFile,
                  "the OM header declares " + std::to_string(header->vertices) + " vertices, " +
                      std::to_string(header->faces) + " faces and " + std::to_string(header->edges) +
                      " edges, more than the rest of the file can hold; is it cut short?",
                  offset);
    }
    has_attributes = has_attributes || (chunk.content != kPosition && chunk.content != kTopology);
  }
  if (!in.at_end()) return fail(ErrorCode::BadFile, "data after the end of the OM file", in.offset());
  if (has_attributes) mesh.note("attributes dropped (normals, colours or texture coordinates)");
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

  Recorder(OpenMeshTriMesh& empty, const OmHeader& header) : Base(empty), header_(header) {}

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
  OpenMesh::FaceHandle add_face(const VHandles&) override {
    throw std::length_error("faces");
  }  // before version 2

  std::size_t n_vertices() const override { return positions.size(); }
  std::size_t n_faces() const override { return halfedge_of_face.size(); }
  std::size_t n_edges() const override { return halfedges.size() / 2; }

  std::vector<Vec3> positions;
  std::vector<Halfedge> halfedges;
  std::vector<std::uint32_t> halfedge_of_face;

 private:
  template <class Handle>
  static std::uint32_t number(Handle handle) {
    return static_cast<std::uint32_t>(handle.idx());  // -1, "none", becomes kNone
  }

  OmHeader header_;
};

bool record(std::span<const std::byte> bytes, Recorder& recorder) {
  const QuietOpenMesh quiet;
  std::istringstream in{std::string(as_text(bytes))};
  OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
  try {
    return OpenMesh::IO::OMReader().read(in, recorder, options);
  } catch (const std::length_error&) {
    return false;
  }
}

/// Goes round each face once. Every half-edge is marked when passed, so a file that crosses its rings ends in
/// false.
bool add_faces(const Recorder& from, MeshBuilder& mesh) {
  std::vector<bool> is_passed(from.halfedges.size());
  std::vector<std::uint32_t> polygon;
  for (std::uint32_t f = 0; f < from.halfedge_of_face.size(); ++f) {
    polygon.clear();
    const std::uint32_t first = from.halfedge_of_face[f];
    std::uint32_t h = first;
    do {
      if (h >= from.halfedges.size() || is_passed[h]) return false;
      const Recorder::Halfedge& halfedge = from.halfedges[h];
      if (halfedge.face != f || halfedge.to_vertex >= from.positions.size()) return false;
      is_passed[h] = true;
      polygon.push_back(halfedge.to_vertex);
      h = halfedge.next;
    } while (h != first);
    mesh.add_polygon(polygon);
  }
  return true;
}

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

Result<MeshFile> parse_om(std::span<const std::byte> bytes) {
  MeshBuilder mesh;
  Result<OmHeader> header = check_chunks(bytes, mesh);
  if (!header) return forward_error(header);
  OpenMeshTriMesh empty;
  Recorder found(empty, *header);
  if (!record(bytes, found)) return fail(ErrorCode::BadFile, "OpenMesh cannot read this OM file");
  if (found.n_vertices() != header->vertices || found.n_faces() != header->faces ||
      found.n_edges() != header->edges) {
    return fail(ErrorCode::BadFile, "the OM header declares " + std::to_string(header->vertices) +
                                        " vertices and " + std::to_string(header->faces) +
                                        " faces, but OpenMesh found " + std::to_string(found.n_vertices()) +
                                        " and " + std::to_string(found.n_faces()));
  }
  for (std::size_t v = 0; v < found.positions.size(); ++v) {
    if (!is_finite(found.positions[v])) {
      return fail(ErrorCode::BadFile,
                  "a coordinate of vertex " + std::to_string(v) + " is not a finite number");
    }
    mesh.add_vertex(found.positions[v]);
  }
  if (!add_faces(found, mesh)) {
    return fail(ErrorCode::BadFile, "the half-edges of this OM file do not make up its faces");
  }
  return std::move(mesh).finish("OM");
}

Result<std::string> format_om(const TriangleSoup& soup) {
  Result<OpenMeshTriMesh> mesh = to_openmesh(soup);
  if (!mesh) return forward_error(mesh);
  OpenMesh::IO::ExporterT<OpenMeshTriMesh> exporter(*mesh);
  std::ostringstream out;
  const QuietOpenMesh quiet;
  if (!OpenMesh::IO::OMWriter().write(out, exporter, OpenMesh::IO::Options::Binary)) {
    return fail(ErrorCode::Io, "OpenMesh could not write the mesh");
  }
  return std::move(out).str();
}

}  // namespace selvage
