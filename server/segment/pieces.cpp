// SPDX-License-Identifier: MIT
#include "server/segment/pieces.h"

namespace selvage {

Pieces find_pieces(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                   std::uint32_t no_label) {
  Pieces pieces{std::vector<std::uint32_t>(mesh.triangle_count(), kNone), {}, {}};
  std::vector<TriangleId> pending;
  for (TriangleId seed = 0; seed < mesh.triangle_count(); ++seed) {
    if (pieces.of_triangle[seed] != kNone || !is_interior(mesh, label_of_vertex, seed, no_label)) continue;
    const std::uint32_t id = pieces.count(), label = label_of_vertex[mesh.vertex(3 * seed)];
    std::uint32_t size = 0;
    pieces.of_triangle[seed] = id;
    pending.push_back(seed);
    while (!pending.empty()) {
      const TriangleId t = pending.back();
      pending.pop_back();
      ++size;
      for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
        const CornerId across = mesh.opposite[c];
        // The two triangles share an edge, so only the vertex beyond it can have another label.
        if (across == kNone || label_of_vertex[mesh.vertex(across)] != label) continue;
        if (pieces.of_triangle[triangle_of(across)] != kNone) continue;
        pieces.of_triangle[triangle_of(across)] = id;
        pending.push_back(triangle_of(across));
      }
    }
    pieces.label.push_back(label);
    pieces.triangle_count.push_back(size);
  }
  return pieces;
}

}  // namespace selvage
