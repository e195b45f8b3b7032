// SPDX-License-Identifier: MIT
#include "server/ingest/split_fans.h"

#include <utility>

namespace selvage {
namespace {

/// Writes `vertex` to every corner of the fan around c. Returns the most clockwise corner of an open fan, c
/// itself of a closed one.
CornerId label_fan(CornerTable& table, CornerId c, VertexId vertex) {
  CornerId at = c;
  do {
    table.vertex_of_corner[at] = vertex;
    at = table.swing_ccw(at);
  } while (at != kNone && at != c);
  if (at == c) return c;

  CornerId first = c;
  for (at = table.swing_cw(c); at != kNone; at = table.swing_cw(at)) {
    table.vertex_of_corner[at] = vertex;
    first = at;
  }
  return first;
}

}  // namespace

SplitTable split_fans(std::vector<VertexId> source_of_corner, std::vector<CornerId> opposite) {
  SplitTable split;
  CornerTable& table = split.table;
  table.opposite = std::move(opposite);
  table.vertex_of_corner.assign(source_of_corner.size(), kNone);
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    if (table.vertex(c) != kNone) continue;
    const auto vertex = static_cast<VertexId>(split.source_of_vertex.size());
    table.corner_of_vertex.push_back(label_fan(table, c, vertex));
    split.source_of_vertex.push_back(source_of_corner[c]);
  }
  return split;
}

}  // namespace selvage
