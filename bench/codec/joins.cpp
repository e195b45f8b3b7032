// SPDX-License-Identifier: MIT
#include "bench/codec/joins.h"

#include <algorithm>
#include <bit>
#include <ctime>
#include <set>
#include <unordered_map>

namespace selvage::bench {

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::size_t raw_strip_bytes(const CornerTable& table, const Partition& partition,
                            std::uint32_t largest_loop_sum) {
  const auto& region = partition.region_of_vertex;
  std::vector<bool> is_open(table.triangle_count(), false);
  for (TriangleId t : partition.boundary_triangles) is_open[t] = true;
  std::size_t vertices = 0, strips = 0;
  // Walks over bridge edges as section 5.2.2 does: right first; the left of a split waits and starts a new
  // strip.
  enum class Turn { None, Left, Right };
  for (TriangleId seed : partition.boundary_triangles) {
    std::vector<CornerId> waiting;  // tips to enter by
    if (is_open[seed]) waiting.push_back(3 * seed);
    while (!waiting.empty()) {
      CornerId tip = waiting.back();
      waiting.pop_back();
      if (!is_open[triangle_of(tip)]) continue;
      ++strips;
      vertices += 2;
      for (Turn last = Turn::None; tip != kNone;) {
        is_open[triangle_of(tip)] = false;
        const auto leads_on = [&](CornerId across) {
          const bool is_bridge =
              across != kNone && region[table.vertex(next(across))] != region[table.vertex(prev(across))];
          return is_bridge && is_open[triangle_of(across)];
        };
        const CornerId right = table.opposite[next(tip)], left = table.opposite[prev(tip)];
        const bool to_right = leads_on(right), to_left = leads_on(left);
        const Turn turn = to_right ? Turn::Right : to_left ? Turn::Left : Turn::None;
        vertices += 1 + (turn != Turn::None && turn == last);  // the inserted vertex of a repeated turn
        if (to_right && to_left) waiting.push_back(left);
        last = turn;
        tip = to_right ? right : to_left ? left : kNone;
      }
    }
  }
  const std::size_t vertex_bits = std::bit_width(partition.region_count) + std::bit_width(largest_loop_sum);
  return 4 + 8 * strips + (vertices * vertex_bits + 7) / 8;
}

Welding weld_by_position(const RepairedMesh& mesh, const Partition& partition, const Grid& grid) {
  Welding welding;
  std::set<std::pair<RegionId, VertexId>> carried;
  std::vector<VertexId> boundary;
  for (TriangleId t : partition.boundary_triangles) {
    const Triangle corners = mesh.table.triangle(t);
    RegionId owner = 0;
    for (VertexId v : corners) owner = std::max(owner, partition.region_of_vertex[v]);
    for (VertexId v : corners) {
      boundary.push_back(v);
      if (partition.region_of_vertex[v] != owner) carried.emplace(owner, v);
    }
  }
  welding.repeated_vertices = static_cast<std::uint32_t>(carried.size());
  std::sort(boundary.begin(), boundary.end());
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());

  const double begin = thread_seconds();
  std::unordered_map<std::uint64_t, VertexId> source_at;
  for (VertexId v : boundary) {
    const GridPoint p = grid.quantise(mesh.positions[v]);
    const std::uint64_t key = static_cast<std::uint64_t>(p.x) << 42 ^ static_cast<std::uint64_t>(p.y) << 21 ^
                              static_cast<std::uint64_t>(p.z);
    const auto [it, is_first] = source_at.emplace(key, mesh.source_of_vertex[v]);
    welding.wrong_welds += !is_first && it->second != mesh.source_of_vertex[v];
  }
  welding.seconds = thread_seconds() - begin;
  return welding;
}

}  // namespace selvage::bench
