// SPDX-License-Identifier: MIT
#include "client/decode/region_decoder.h"

#include <algorithm>
#include <numeric>

#include "client/decode/attribute_decoder.h"
#include "client/decode/boundary_map_decoder.h"
#include "client/decode/connectivity_decoder.h"
#include "client/decode/exact_decoder.h"
#include "client/decode/list_decoder.h"
#include "common/codec/region_format.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

/// Loose vertices have no triangles; all of them are boundary vertices.
bool decode_loose_vertices(EntropyDecoder& in, std::uint32_t expected, RegionMesh& mesh) {
  const std::uint32_t count = in.number(region_model::kLooseCount);
  if (count == 0 || count != expected) return false;
  mesh.loops.vertices.resize(count);
  std::iota(mesh.loops.vertices.begin(), mesh.loops.vertices.end(), VertexId{0});
  mesh.loops.lengths = {count};
  return true;
}

std::uint64_t finest_boundary(const CoarseLevel& coarse) {
  const auto& lengths = coarse.finest_loop_lengths;
  return std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t decode_memory_bound(const DecodeLimits& expected) {
  const std::uint64_t boundary = expected.coarse ? finest_boundary(*expected.coarse) : 0;
  const std::uint64_t exact = expected.exact ? expected.vertices : 0;
  return 65536 + 448 * std::uint64_t{expected.triangles} + 192 * std::uint64_t{expected.vertices} +
         192 * exact + 16 * boundary;
}

Result<RegionMesh> RegionDecoder::decode(std::span<const std::byte> bytes, const DecodeLimits& expected,
                                         const CodecTables& tables) {
  ByteReader reader(bytes);
  auto header = read_region_header(reader);
  if (!header) return forward_error(header);
  EntropyDecoder in(bytes.subspan(1), tables.region);

  const int dropped_bits = expected.coarse ? expected.coarse->dropped_bits : 0;
  const GridBox box = drop_bits({expected.box_min, expected.box_max}, dropped_bits);
  const auto mismatch = [] {
    return fail(ErrorCode::BadStream,
                "region part: not the vertices and triangles that the directory promises");
  };
  // A symbol may be cheap but is not free: so much cannot come from so few bytes.
  const std::size_t most = kMaxSymbolsPerByte * bytes.size();
  if (std::max(expected.triangles, expected.vertices) > most) return mismatch();
  if (expected.coarse && finest_boundary(*expected.coarse) > most) return mismatch();
  RegionMesh mesh;
  bool is_listed = false;
  if (expected.triangles > 0) {
    if (auto ok = decode_connectivity(in, expected.triangles, table_); !ok) return forward_error(ok);
    if (table_.triangle_count() != expected.triangles) return mismatch();
    const unsigned way = in.symbol(region_model::kIsListed);
    if (way > 1) return fail(ErrorCode::BadStream, "region part: positions in an unknown way");
    is_listed = way == 1;
    const Grid* exact = expected.exact ? &*expected.exact : nullptr;
    auto ok = is_listed
                  ? decode_listed_positions(in, box, expected.vertices, exact, table_, memory_.order, mesh)
                  : decode_positions(in, box, expected.vertices, tables, table_, memory_, mesh);
    if (!ok) return forward_error(ok);
  } else {
    if (!decode_loose_vertices(in, expected.vertices, mesh)) return mismatch();
    if (auto ok = decode_loose_positions(in, expected.vertices, box, mesh); !ok) return forward_error(ok);
  }
  if (header->has_exact != expected.exact.has_value() || header->is_coarse != expected.coarse.has_value())
    return mismatch();
  if (expected.exact && !is_listed) {
    auto exact = decode_exact(mesh.positions, *expected.exact, in);
    if (!exact) return forward_error(exact);
    mesh.exact = std::move(*exact);
  }
  if (expected.coarse) {
    auto ok = decode_boundary_map(in, expected.coarse->finest_loop_lengths, mesh);
    if (!ok) return forward_error(ok);
    for (GridPoint& p : mesh.positions) p = restore_bits(p, dropped_bits);
  } else {
    mesh.vertex_of_boundary = mesh.loops.vertices;
  }
  if (auto ok = decode_turned_and_anchors(in, *header, mesh); !ok) return forward_error(ok);
  return mesh;
}

Result<RegionMesh> decode_region(std::span<const std::byte> bytes, const DecodeLimits& expected,
                                 const CodecTables& tables) {
  return RegionDecoder().decode(bytes, expected, tables);
}

}  // namespace selvage
