// SPDX-License-Identifier: MIT
#include "server/simplify/bridge_links.h"

#include <utility>

namespace selvage {

BridgeLinks::BridgeLinks(const CornerTable& mesh, std::span<const RegionId> region_of_vertex) {
  if (region_of_vertex.empty()) return;
  far_ends_ = GatheredLists<VertexId>(mesh.vertex_count());
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    if (mesh.opposite[c] != kNone && mesh.opposite[c] < c) continue;  // each edge once
    const VertexId a = mesh.vertex(next(c)), b = mesh.vertex(prev(c));
    if (region_of_vertex[a] == region_of_vertex[b]) continue;
    far_ends_.add(a, b);
    far_ends_.add(b, a);
  }
}

bool BridgeLinks::has_one_common_neighbour(VertexId u, VertexId v,
                                           std::span<const VertexId> representative_of_vertex,
                                           Stamps& stamps) const {
  const auto image = [&](VertexId y) {
    return representative_of_vertex.empty() ? y : representative_of_vertex[y];
  };
  stamps.clear();
  far_ends_.all_of(u, [&](VertexId y) {
    stamps.insert(image(y));
    return true;
  });
  std::uint32_t common = 0;
  far_ends_.all_of(v, [&](VertexId y) {
    if (stamps.contains(image(y))) {
      stamps.erase(image(y));  // counts once
      ++common;
    }
    return true;
  });
  return common == 1;
}

bool BridgeLinks::keep_one_common_neighbour(VertexId u, VertexId v, Stamps& stamps) const {
  if (!has_one_common_neighbour(u, v, {}, stamps)) return false;
  for (const auto& level : published_) {
    if (!has_one_common_neighbour(u, v, level, stamps)) return false;
  }
  return true;
}

void BridgeLinks::collapse(VertexId u, VertexId v) {
  if (!far_ends_.is_empty()) far_ends_.collapse(u, v);
}

void BridgeLinks::publish(std::vector<VertexId> representative_of_vertex) {
  if (!far_ends_.is_empty()) published_.push_back(std::move(representative_of_vertex));
}

}  // namespace selvage
