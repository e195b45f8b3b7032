// SPDX-License-Identifier: MIT
#include "server/segment/erosion.h"

#include <vector>

namespace selvage {
namespace {

/// Plateau vertices beside a basin, labelled only once all are known so that the first step is one edge wide.
std::vector<VertexId> label_first_front(const Neighbours& neighbours,
                                        std::vector<std::uint32_t>& label_of_vertex) {
  std::vector<VertexId> front;
  std::vector<std::uint32_t> label_of_front;
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    if (label_of_vertex[v] != kNone) continue;
    std::uint32_t label = kNone;
    for (VertexId u : neighbours[v]) {
      if (label == kNone) label = label_of_vertex[u];
    }
    if (label == kNone) continue;
    front.push_back(v);
    label_of_front.push_back(label);
  }
  for (std::size_t i = 0; i < front.size(); ++i) label_of_vertex[front[i]] = label_of_front[i];
  return front;
}

/// Breadth first from `queue`, whose vertices are labelled.
void spread(const Neighbours& neighbours, std::vector<VertexId>& queue,
            std::vector<std::uint32_t>& label_of_vertex) {
  for (std::size_t at = 0; at < queue.size(); ++at) {
    const VertexId v = queue[at];
    for (VertexId u : neighbours[v]) {
      if (label_of_vertex[u] != kNone) continue;
      label_of_vertex[u] = label_of_vertex[v];
      queue.push_back(u);
    }
  }
}

}  // namespace

void erode_plateau(const Neighbours& neighbours, Minima& minima) {
  std::vector<VertexId> queue = label_first_front(neighbours, minima.label_of_vertex);
  spread(neighbours, queue, minima.label_of_vertex);
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    if (minima.label_of_vertex[v] != kNone) continue;
    minima.label_of_vertex[v] = minima.count++;
    queue.assign(1, v);
    spread(neighbours, queue, minima.label_of_vertex);
  }
}

}  // namespace selvage
