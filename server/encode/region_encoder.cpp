// SPDX-License-Identifier: MIT
#include "server/encode/region_encoder.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "common/codec/region_format.h"
#include "server/encode/attribute_encoder.h"
#include "server/encode/boundary_map_encoder.h"
#include "server/encode/connectivity_encoder.h"
#include "server/encode/exact_encoder.h"
#include "server/encode/list_encoder.h"

namespace selvage {
namespace {

/// The boundary of loose vertices, which have no triangles, is all of them.
BoundaryLoops loose_loops(std::uint32_t vertices) {
  BoundaryLoops loops;
  loops.vertices.resize(vertices);
  std::iota(loops.vertices.begin(), loops.vertices.end(), VertexId{0});
  if (vertices > 0) loops.lengths.push_back(vertices);
  return loops;
}

/// Vertices that grew and were merged away map to kNone.
std::vector<VertexId> map_vertices(const EncodedConnectivity& connectivity, const CornerTable& source) {
  std::vector<VertexId> source_of_vertex(connectivity.table.vertex_count(), kNone);
  for (CornerId c = 0; c < connectivity.source_of_corner.size(); ++c) {
    source_of_vertex[connectivity.table.vertex(fan_corner(c))] =
        source.vertex(connectivity.source_of_corner[c]);
  }
  return source_of_vertex;
}

std::vector<bool> map_turned(const EncodedConnectivity& connectivity, const std::vector<bool>& is_turned) {
  if (std::find(is_turned.begin(), is_turned.end(), true) == is_turned.end()) return {};
  std::vector<bool> mapped(connectivity.table.triangle_count());
  for (TriangleId t = 0; t < mapped.size(); ++t)
    mapped[t] = is_turned[triangle_of(connectivity.source_of_corner[3 * t])];
  return mapped;
}

std::vector<Anchor> map_anchors(const RegionMesh& mesh, const std::vector<VertexId>& source_of_vertex,
                                const std::vector<std::uint32_t>& weld_groups) {
  std::vector<Anchor> anchors;
  if (weld_groups.empty()) return anchors;
  for (VertexId v : anchor_order(mesh.loops, mesh.vertex_count())) {
    const std::uint32_t group = weld_groups[source_of_vertex[v]];
    if (group != kNone) anchors.push_back({v, group});
  }
  return anchors;
}

std::vector<VertexId> map_boundary(const CoarseSource& coarse, std::span<const VertexId> source_of_vertex) {
  std::vector<VertexId> vertex_of_source(source_of_vertex.size());
  for (VertexId v = 0; v < source_of_vertex.size(); ++v) vertex_of_source[source_of_vertex[v]] = v;
  std::vector<VertexId> mapped;
  mapped.reserve(coarse.vertex_of_boundary.size());
  for (VertexId source : coarse.vertex_of_boundary) mapped.push_back(vertex_of_source[source]);
  return mapped;
}

template <class T>
std::vector<T> gathered(std::span<const T> values, std::span<const VertexId> order) {
  std::vector<T> result;
  result.reserve(order.size());
  for (VertexId v : order) result.push_back(values[v]);
  return result;
}

/// Whether the grid points are those of the floats, and so need no coding of their own.
bool follow(const Grid& grid, std::span<const GridPoint> positions, std::span<const ExactPosition> exact) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!(grid.quantise({exact[v][0], exact[v][1], exact[v][2]}) == positions[v])) return false;
  }
  return true;
}

/// Replaces the positions, and floats, that were coded into `out` since `before` by places in lists if that
/// takes fewer bytes.
void try_lists(const FanTable& table, std::span<const GridPoint> positions,
               std::span<const ExactPosition> exact, const CodecTables& tables, EntropyEncoder before,
               EntropyEncoder& out) {
  before.symbol(region_model::kIsListed, 1);
  if (exact.empty()) {
    encode_listed_positions(table, positions, before);
  } else {
    encode_listed_floats(table, exact, before);
  }
  const auto size_of = [&](const EntropyEncoder& coded) { return coded.finish(tables.region).bytes.size(); };
  if (size_of(before) < size_of(out)) out = std::move(before);
}

GridBox box_of(std::span<const GridPoint> positions) {
  GridBox box{positions.front(), positions.front()};
  for (const GridPoint& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

}  // namespace

EncodedRegion encode_region(const RegionSource& source, const CodecTables& tables, EntropyEncoder* symbols) {
  EncodedRegion encoded;
  encoded.box = source.coarse ? source.coarse->finest_box : box_of(source.positions);
  const int dropped_bits = source.coarse ? source.coarse->dropped_bits : 0;
  const GridBox box = drop_bits(encoded.box, dropped_bits);
  EntropyEncoder out;
  RegionMesh mesh;
  if (source.table.triangle_count() > 0) {
    EncodedConnectivity connectivity = encode_connectivity(source.table, out);
    out.mark();
    const EntropyEncoder before_positions = out;
    const std::vector<VertexId> source_of_grown = map_vertices(connectivity, source.table);
    std::vector<GridPoint> positions;
    for (VertexId v : source_of_grown)
      positions.push_back(v == kNone ? GridPoint{} : drop_bits(source.positions[v], dropped_bits));
    out.symbol(region_model::kIsListed, 0);
    CodingOrder order = encode_positions(connectivity.table, positions, box, tables, out);
    for (VertexId grown : order.vertices) encoded.source_of_vertex.push_back(source_of_grown[grown]);
    mesh.positions = gathered<GridPoint>(positions, order.vertices);
    mesh.is_turned = map_turned(connectivity, source.is_turned);
    mesh.triangles = std::move(order.triangles);
    mesh.loops = std::move(order.loops);
    if (!source.exact.empty()) {
      mesh.exact = gathered<ExactPosition>(source.exact, encoded.source_of_vertex);
      encode_exact(mesh.positions, mesh.exact, source.grid, out);
    }
    if (source.exact.empty() ? may_be_listed(mesh.triangles, mesh.positions)
                             : follow(source.grid, mesh.positions, mesh.exact))
      try_lists(connectivity.table, mesh.positions, mesh.exact, tables, before_positions, out);
  } else {
    out.number(region_model::kLooseCount, source.table.vertex_count());
    out.mark();
    encode_loose_positions(source.positions, box, out);
    mesh.positions = source.positions;
    mesh.loops = loose_loops(source.table.vertex_count());
    encoded.source_of_vertex = mesh.loops.vertices;
    mesh.exact = source.exact;
    if (!mesh.exact.empty()) encode_exact(source.positions, mesh.exact, source.grid, out);
  }
  mesh.anchors = map_anchors(mesh, encoded.source_of_vertex, source.weld_groups);
  if (source.coarse) {
    mesh.vertex_of_boundary = map_boundary(*source.coarse, encoded.source_of_vertex);
    encode_boundary_map(mesh, source.coarse->finest_loop_lengths, out);
  }
  encode_turned_and_anchors(mesh, out);

  ByteWriter part;
  write_region_header(part, {.has_turned = !mesh.is_turned.empty(),
                             .has_anchors = !mesh.anchors.empty(),
                             .has_exact = !mesh.exact.empty(),
                             .is_coarse = source.coarse.has_value()});
  const EntropyEncoder::Coded coded = out.finish(tables.region);
  part.append(coded.bytes);
  encoded.connectivity_size = coded.bytes_to_mark;
  encoded.bytes = std::move(part).take();
  encoded.loops = std::move(mesh.loops);
  if (symbols != nullptr) *symbols = std::move(out);
  return encoded;
}

}  // namespace selvage
