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

/// Vertices that are not in `order` have no corner.
void renumber_vertices(CornerTable& table, std::span<const VertexId> order) {
  std::vector<VertexId> rank(table.vertex_count(), kNone);
  std::vector<CornerId> corner_of_vertex(order.size());
  for (VertexId i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    corner_of_vertex[i] = table.corner_of_vertex[order[i]];
  }
  for (VertexId& v : table.vertex_of_corner) v = rank[v];
  table.corner_of_vertex = std::move(corner_of_vertex);
}

/// Vertices that wait to be coded. A vertex may wait in both queues; whoever pops it second finds it known.
class GeometryOrder {
 public:
  explicit GeometryOrder(const CornerTable& table)
      : table_(table),
        states_(table.vertex_count(), kUnseen),
        well_(table.vertex_count()),
        once_(table.vertex_count()) {
    order_.reserve(table.vertex_count());
  }

  std::vector<VertexId> run() && {
    // A component starts with the first vertex of its first triangle, which nothing predicts.
    for (CornerId c = 0; c < table_.corner_count(); ++c) {
      if (states_[table_.vertex_of_corner[c]] == kKnown) continue;
      add(table_.vertex_of_corner[c]);
      add_all_reachable();
    }
    return std::move(order_);
  }

 private:
  /// How many triangles predict a vertex; two stands for more.
  enum State : std::uint8_t { kUnseen, kOnce, kWell, kKnown };

  void add_all_reachable() {
    while (true) {
      VertexId v = kNone;
      if (next_well_ < well_end_) {
        v = well_[next_well_++];
      } else if (next_once_ < once_end_) {
        v = once_[next_once_++];
      } else {
        return;
      }
      if (states_[v] != kKnown) add(v);
    }
  }

  void add(VertexId v) {
    states_[v] = kKnown;
    order_.push_back(v);
    // The fan counter-clockwise; what comes before one corner comes after the next, see swing_ccw.
    const CornerId first = table_.corner_of_vertex[v];
    CornerId c = next(first);
    VertexId after = table_.vertex_of_corner[c], before = table_.vertex_of_corner[prev(first)];
    while (true) {
      const bool after_is_known = states_[after] == kKnown, before_is_known = states_[before] == kKnown;
      if (before_is_known && !after_is_known) offer(after);
      if (after_is_known && !before_is_known) offer(before);
      const CornerId across = table_.opposite[c];
      if (across == kNone) return;
      const CornerId at = next(across);
      if (at == first) return;
      c = next(at);
      after = before;
      before = table_.vertex_of_corner[across];
    }
  }

  /// Counts one more triangle that predicts v; only the first and the second change where it waits.
  void offer(VertexId v) {
    if (states_[v] == kUnseen) {
      states_[v] = kOnce;
      once_[once_end_++] = v;
    } else if (states_[v] == kOnce) {
      states_[v] = kWell;
      well_[well_end_++] = v;
    }
  }

  const CornerTable& table_;
  std::vector<std::uint8_t> states_;
  std::vector<VertexId> order_, well_, once_;
  std::size_t next_well_ = 0, well_end_ = 0, next_once_ = 0, once_end_ = 0;
};

}  // namespace

std::vector<VertexId> geometry_order(const CornerTable& table) { return GeometryOrder(table).run(); }

std::optional<Connectivity> finish_connectivity(CornerTable grown,
                                                std::span<const VertexId> virtual_vertices) {
  if (!is_strictly_ascending_below(virtual_vertices, grown.vertex_count())) return std::nullopt;
  Connectivity result;
  if (!virtual_vertices.empty()) {
    result.grown_of_triangle = drop_virtual_fans(grown, virtual_vertices);
    if (has_two_open_fans(grown)) return std::nullopt;
  }
  renumber_vertices(grown, geometry_order(grown));
  result.table = std::move(grown);
  return result;
}

}  // namespace selvage
