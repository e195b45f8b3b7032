// SPDX-License-Identifier: MIT
#include "server/segment/minima.h"

namespace selvage {

Minima label_minima(const Neighbours& neighbours, std::span<const std::uint8_t> is_plateau) {
  Minima minima{std::vector<std::uint32_t>(neighbours.vertex_count(), kNone), 0};
  std::vector<VertexId> pending;
  for (VertexId seed = 0; seed < neighbours.vertex_count(); ++seed) {
    if (is_plateau[seed] || minima.label_of_vertex[seed] != kNone) continue;
    const std::uint32_t label = minima.count++;
    minima.label_of_vertex[seed] = label;
    pending.push_back(seed);
    while (!pending.empty()) {
      const VertexId v = pending.back();
      pending.pop_back();
      for (VertexId u : neighbours[v]) {
        if (is_plateau[u] || minima.label_of_vertex[u] != kNone) continue;
        minima.label_of_vertex[u] = label;
        pending.push_back(u);
      }
    }
  }
  return minima;
}

}  // namespace selvage
