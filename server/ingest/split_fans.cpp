// SPDX-License-Identifier: MIT
#include "server/ingest/split_fans.h"

#include <utility>

namespace selvage {
namespace {

/// The most clockwise corner of an open fan, `c` itself in a closed one.
CornerId first_of_fan(const CornerTable& table, CornerId c) {
  for (CornerId at = c;;) {
    const CornerId clockwise = table.swing_cw(at);
    if (clockwise == kNone) return at;
    if (clockwise == c) return c;
    at = clockwise;
  }
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
    const CornerId first = first_of_fan(table, c);
    split.source_of_vertex.push_back(source_of_corner[c]);
    table.corner_of_vertex.push_back(first);
    for (CornerId at = first; at != kNone && table.vertex(at) == kNone; at = table.swing_ccw(at)) {
      table.vertex_of_corner[at] = vertex;
    }
  }
  return split;
}

}  // namespace selvage
