// SPDX-License-Identifier: MIT
#include "client/decode/region_decoder.h"

#include "client/decode/attribute_decoder.h"
#include "client/decode/connectivity_decoder.h"
#include "common/codec/region_format.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

/// Symbols beyond the region's own triangles belong to fans around virtual vertices: each such triangle has
/// an edge on a boundary loop, so there are fewer of them than there are edges.
bool is_plausible(const RegionPartHeader& header, const DecodeLimits& expected) {
  const std::uint64_t with_fans = std::uint64_t{4} * expected.triangles;
  return header.symbols <= with_fans && header.symbols <= kMaxSymbolsPerByte * header.connectivity_size;
}

}  // namespace

Result<RegionMesh> decode_region(std::span<const std::byte> bytes, const DecodeLimits& expected) {
  ByteReader in(bytes);
  auto header = read_region_header(in);
  if (!header) return forward_error(header);
  if (!is_plausible(*header, expected))
    return fail(ErrorCode::BadStream, "region part: more symbols than the directory allows", 2);

  RegionMesh mesh;
  if (header->symbols > 0) {
    auto table = decode_connectivity(in.take(header->connectivity_size), header->symbols);
    if (!table) return forward_error(table);
    mesh.table = std::move(*table);
    mesh.loops = find_boundary_loops(mesh.table);
  }
  const bool is_loose = header->symbols == 0;
  if (mesh.table.triangle_count() != expected.triangles ||
      (!is_loose && mesh.table.vertex_count() != expected.vertices)) {
    return fail(ErrorCode::BadStream,
                "region part: not the vertices and triangles that the directory promises");
  }
  if (auto ok = decode_attributes(in.take(in.left()), *header, expected.vertices, mesh); !ok)
    return forward_error(ok);
  return mesh;
}

}  // namespace selvage
