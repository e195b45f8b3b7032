// SPDX-License-Identifier: MIT
#include "client/decode/region_decoder.h"

#include <numeric>

#include "client/decode/attribute_decoder.h"
#include "client/decode/connectivity_decoder.h"
#include "common/codec/region_format.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

/// Loose vertices have no triangles; all of them are boundary vertices.
bool decode_loose_vertices(EntropyDecoder<2>& in, std::uint32_t expected, RegionMesh& mesh) {
  const std::uint32_t count = in.number(region_model::kLooseCount);
  if (count == 0 || count != expected) return false;
  mesh.table.set_corner_of_vertex(count);
  mesh.loops.vertices.resize(count);
  std::iota(mesh.loops.vertices.begin(), mesh.loops.vertices.end(), VertexId{0});
  mesh.loops.lengths = {count};
  return true;
}

}  // namespace

Result<RegionMesh> decode_region(std::span<const std::byte> bytes, const DecodeLimits& expected,
                                 const CodecTables& tables) {
  ByteReader reader(bytes);
  auto header = read_region_header(reader);
  if (!header) return forward_error(header);
  EntropyDecoder<2> in(bytes.subspan(1), tables.region);

  RegionMesh mesh;
  if (expected.triangles > 0) {
    // A symbol may be cheap but is not free: so many triangles cannot come from so few bytes.
    if (expected.triangles > kMaxSymbolsPerByte * bytes.size())
      return fail(ErrorCode::BadStream, "region part: fewer bytes than its triangles take");
    auto table = decode_connectivity(in, expected.triangles);
    if (!table) return forward_error(table);
    mesh.table = std::move(*table);
    mesh.loops = find_boundary_loops(mesh.table);
  } else if (!decode_loose_vertices(in, expected.vertices, mesh)) {
    return fail(ErrorCode::BadStream, "region part: impossible number of loose vertices");
  }
  if (mesh.table.triangle_count() != expected.triangles || mesh.table.vertex_count() != expected.vertices) {
    return fail(ErrorCode::BadStream,
                "region part: not the vertices and triangles that the directory promises");
  }
  if (auto ok = decode_attributes(in, *header, expected, tables, mesh); !ok) return forward_error(ok);
  return mesh;
}

}  // namespace selvage
