// SPDX-License-Identifier: MIT
#include "server/simplify/bridge_links.h"

#include <utility>

namespace selvage {

BridgeLinks::BridgeLinks(const CornerTable& mesh, std::span<const RegionId> region_of_vertex) {
  if (region_of_vertex.empty()) return;
  first_of_vertex_.assign(mesh.vertex_count(), kNone);
  last_of_vertex_.assign(mesh.vertex_count(), kNone);
  const auto add = [&](VertexId v, VertexId far_end) {
    const auto entry = static_cast<std::uint32_t>(far_end_.size());
    far_end_.push_back(far_end);
    next_.push_back(first_of_vertex_[v]);
    if (first_of_vertex_[v] == kNone) last_of_vertex_[v] = entry;
    first_of_vertex_[v] = entry;
  };
  for (CornerId c = 0; c < mesh.corner_count(); ++c) {
    if (mesh.opposite[c] != kNone && mesh.opposite[c] < c) continue;  // each edge once
    const VertexId a = mesh.vertex(next(c)), b = mesh.vertex(prev(c));
    if (region_of_vertex[a] == region_of_vertex[b]) continue;
    add(a, b);
    add(b, a);
  }
}

bool BridgeLinks::has_one_common_neighbour(VertexId u, VertexId v,
                                           std::span<const VertexId> representative_of_vertex,
                                           Stamps& stamps) const {
  const auto image = [&](std::uint32_t entry) {
    const VertexId y = far_end_[entry];
    return representative_of_vertex.empty() ? y : representative_of_vertex[y];
  };
  stamps.clear();
  for (std::uint32_t at = first_of_vertex_[u]; at != kNone; at = next_[at]) stamps.insert(image(at));
  std::uint32_t common = 0;
  for (std::uint32_t at = first_of_vertex_[v]; at != kNone; at = next_[at]) {
    if (!stamps.contains(image(at))) continue;
    stamps.erase(image(at));  // counts once
    ++common;
  }
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
  if (first_of_vertex_.empty() || first_of_vertex_[u] == kNone) return;
  if (first_of_vertex_[v] == kNone) {
    first_of_vertex_[v] = first_of_vertex_[u];
  } else {
    next_[last_of_vertex_[v]] = first_of_vertex_[u];
  }
  last_of_vertex_[v] = last_of_vertex_[u];
  first_of_vertex_[u] = last_of_vertex_[u] = kNone;
}

void BridgeLinks::publish(std::vector<VertexId> representative_of_vertex) {
  if (!first_of_vertex_.empty()) published_.push_back(std::move(representative_of_vertex));
}

}  // namespace selvage
