// SPDX-License-Identifier: MIT
#include "server/segment/samples.h"

#include "server/segment/one_ring.h"

namespace selvage {
namespace {

/// Marks what lies within `reach` edges of a vertex, over and over.
class Coverage {
 public:
  explicit Coverage(const CornerTable& mesh) : mesh_(mesh), last_visit_(mesh.vertex_count(), kNone) {}

  bool is_covered(VertexId v) const { return last_visit_[v] != kNone; }

  void cover(VertexId centre, int reach) {
    last_visit_[centre] = centre;
    disc_.assign(1, centre);
    for (std::size_t at = 0; reach > 0; --reach) {
      for (const std::size_t end = disc_.size(); at < end; ++at) {
        for_each_neighbour(mesh_, disc_[at], [&](VertexId u) {
          if (last_visit_[u] == centre) return;
          last_visit_[u] = centre;
          disc_.push_back(u);
        });
      }
    }
  }

 private:
  const CornerTable& mesh_;
  std::vector<VertexId> last_visit_;  // the last centre whose disc held the vertex
  std::vector<VertexId> disc_;
};

}  // namespace

std::vector<VertexId> choose_samples(const CornerTable& mesh,
                                     std::span<const std::uint8_t> spacing_of_vertex) {
  Coverage coverage(mesh);
  std::vector<VertexId> samples;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corner_of_vertex[v] == kNone || mesh.is_border_vertex(v)) continue;
    if (spacing_of_vertex[v] > 1 && coverage.is_covered(v)) continue;
    samples.push_back(v);
    coverage.cover(v, spacing_of_vertex[v] - 1);
  }
  return samples;
}

void spread_from_samples(const CornerTable& mesh, std::span<const VertexId> samples, int sweeps,
                         std::span<float> value_of_vertex) {
  std::vector<bool> is_reached(mesh.vertex_count(), false);
  std::vector<VertexId> order(samples.begin(), samples.end());
  for (VertexId v : samples) is_reached[v] = true;
  for (std::size_t at = 0; at < order.size(); ++at) {
    const VertexId v = order[at];
    for_each_neighbour(mesh, v, [&](VertexId u) {
      if (is_reached[u]) return;
      is_reached[u] = true;
      value_of_vertex[u] = value_of_vertex[v];
      order.push_back(u);
    });
  }
  if (order.size() == samples.size()) return;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t at = samples.size(); at < order.size(); ++at) {
      float sum = value_of_vertex[order[at]];
      int count = 1;
      for_each_neighbour(mesh, order[at], [&](VertexId u) {
        sum += value_of_vertex[u];
        ++count;
      });
      value_of_vertex[order[at]] = sum / static_cast<float>(count);
    }
  }
}

}  // namespace selvage
