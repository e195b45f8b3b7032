// SPDX-License-Identifier: MIT
#include "server/encode/region_encoder.h"

#include <algorithm>
#include <numeric>

#include "common/codec/region_format.h"
#include "server/encode/attribute_encoder.h"
#include "server/encode/connectivity_encoder.h"

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

std::vector<VertexId> map_vertices(const EncodedConnectivity& connectivity, const CornerTable& source) {
  std::vector<VertexId> source_of_vertex(connectivity.table.vertex_count());
  for (CornerId c = 0; c < connectivity.table.corner_count(); ++c) {
    source_of_vertex[connectivity.table.vertex(c)] = source.vertex(connectivity.source_of_corner[c]);
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
  for (VertexId v : anchor_order(mesh.loops, mesh.table.vertex_count())) {
    const std::uint32_t group = weld_groups[source_of_vertex[v]];
    if (group != kNone) anchors.push_back({v, group});
  }
  return anchors;
}

}  // namespace

EncodedRegion encode_region(const RegionSource& source, int bits) {
  EncodedRegion encoded;
  RegionMesh mesh;
  EncodedConnectivity connectivity;
  if (source.table.triangle_count() > 0) {
    connectivity = encode_connectivity(source.table);
    mesh.table = connectivity.table;
    mesh.loops = find_boundary_loops(mesh.table);
    encoded.source_of_vertex = map_vertices(connectivity, source.table);
    mesh.is_turned = map_turned(connectivity, source.is_turned);
  } else {
    mesh.table = source.table;
    mesh.loops = loose_loops(source.table.vertex_count());
    encoded.source_of_vertex = mesh.loops.vertices;
  }
  for (VertexId v : encoded.source_of_vertex) mesh.positions.push_back(source.positions[v]);
  mesh.anchors = map_anchors(mesh, encoded.source_of_vertex, source.weld_groups);

  ByteWriter out;
  write_region_header(out, {.has_turned = !mesh.is_turned.empty(),
                            .has_anchors = !mesh.anchors.empty(),
                            .bits = bits,
                            .symbols = connectivity.symbols,
                            .connectivity_size = static_cast<std::uint32_t>(connectivity.bytes.size())});
  encoded.header_size = out.size();
  encoded.connectivity_size = connectivity.bytes.size();
  out.append(connectivity.bytes);
  out.append(encode_attributes(mesh, bits));
  encoded.bytes = std::move(out).take();
  encoded.loops = std::move(mesh.loops);
  return encoded;
}

}  // namespace selvage
