// SPDX-License-Identifier: MIT
#include "common/codec/connectivity.h"

#include <algorithm>

namespace selvage {
namespace {

bool is_strictly_ascending_below(std::span<const VertexId> vertices, std::uint32_t limit) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] >= limit || (i > 0 && vertices[i] <= vertices[i - 1])) return false;
  }
  return true;
}

/// Compacts the table to the triangles that touch no virtual vertex; returns their grown numbers.
std::vector<TriangleId> drop_virtual_fans(CornerTable& table, std::span<const VertexId> virtual_vertices) {
  std::vector<bool> is_virtual(table.vertex_count(), false);
  for (VertexId v : virtual_vertices) is_virtual[v] = true;
  std::vector<TriangleId> kept;
  std::vector<TriangleId> new_of_grown(table.triangle_count(), kNone);
  for (TriangleId t = 0; t < table.triangle_count(); ++t) {
    const auto [a, b, c] = table.triangle(t);
    if (is_virtual[a] || is_virtual[b] || is_virtual[c]) continue;
    new_of_grown[t] = static_cast<TriangleId>(kept.size());
    kept.push_back(t);
  }
  for (TriangleId t = 0; t < kept.size(); ++t) {
    for (CornerId k = 0; k < 3; ++k) {
      const CornerId grown = 3 * kept[t] + k;
      const CornerId across = table.opposite[grown];
      const TriangleId neighbour = across == kNone ? kNone : new_of_grown[triangle_of(across)];
      table.vertex_of_corner[3 * t + k] = table.vertex_of_corner[grown];
      table.opposite[3 * t + k] = neighbour == kNone ? kNone : 3 * neighbour + across % 3;
    }
  }
  table.vertex_of_corner.resize(3 * kept.size());
  table.opposite.resize(3 * kept.size());
  table.set_corner_of_vertex(table.vertex_count());
  return kept;
}

/// Taking fans away may leave a vertex that two of them shared with two fans of its own.
bool has_two_open_fans(const CornerTable& table) {
  std::vector<bool> is_open(table.vertex_count(), false);
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    if (table.opposite[prev(c)] != kNone) continue;
    if (is_open[table.vertex(c)]) return true;
    is_open[table.vertex(c)] = true;
  }
  return false;
}

void renumber_vertices(CornerTable& table, std::span<const VertexId> order) {
  std::vector<VertexId> rank(table.vertex_count(), kNone);
  for (VertexId i = 0; i < order.size(); ++i) rank[order[i]] = i;
  for (VertexId& v : table.vertex_of_corner) v = rank[v];
  table.set_corner_of_vertex(static_cast<std::uint32_t>(order.size()));
}

/// Vertices that wait to be coded. A vertex may wait in both queues; whoever pops it second finds it known.
class GeometryOrder {
 public:
  explicit GeometryOrder(const CornerTable& table)
      : table_(table), is_known_(table.vertex_count(), false), predictions_(table.vertex_count(), 0) {
    order_.reserve(table.vertex_count());
  }

  std::vector<VertexId> run() && {
    // A component starts with the first two vertices of its first triangle, which nothing predicts.
    for (CornerId c = 0; c < table_.corner_count(); ++c) {
      if (is_known_[table_.vertex(c)]) continue;
      add(table_.vertex(c));
      add_all_reachable();
    }
    return std::move(order_);
  }

 private:
  void add_all_reachable() {
    while (true) {
      VertexId v = kNone;
      if (next_well_ < well_.size()) {
        v = well_[next_well_++];
      } else if (next_once_ < once_.size()) {
        v = once_[next_once_++];
      } else {
        return;
      }
      if (!is_known_[v]) add(v);
    }
  }

  void add(VertexId v) {
    is_known_[v] = true;
    order_.push_back(v);
    const CornerId first = table_.corner_of_vertex[v];
    for (CornerId c = first; c != kNone;) {
      const VertexId after = table_.vertex(next(c)), before = table_.vertex(prev(c));
      if (is_known_[before] && !is_known_[after]) offer(after);
      if (is_known_[after] && !is_known_[before]) offer(before);
      c = table_.swing_ccw(c);
      if (c == first) break;
    }
  }

  /// Counts one more triangle that predicts v; only the first and the second change where it waits.
  void offer(VertexId v) {
    if (predictions_[v] == 2) return;
    (++predictions_[v] == 1 ? once_ : well_).push_back(v);
  }

  const CornerTable& table_;
  std::vector<bool> is_known_;
  std::vector<std::uint8_t> predictions_;
  std::vector<VertexId> order_, well_, once_;
  std::size_t next_well_ = 0, next_once_ = 0;
};

}  // namespace

std::vector<VertexId> geometry_order(const CornerTable& table) { return GeometryOrder(table).run(); }

std::optional<Connectivity> finish_connectivity(CornerTable grown,
                                                std::span<const VertexId> virtual_vertices) {
  if (!is_strictly_ascending_below(virtual_vertices, grown.vertex_count())) return std::nullopt;
  Connectivity result;
  result.grown_of_triangle = drop_virtual_fans(grown, virtual_vertices);
  if (!virtual_vertices.empty() && has_two_open_fans(grown)) return std::nullopt;
  const std::vector<VertexId> order = geometry_order(grown);
  renumber_vertices(grown, order);
  result.table = std::move(grown);
  return result;
}

}  // namespace selvage
