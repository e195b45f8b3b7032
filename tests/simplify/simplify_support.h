// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// What collapses must not change.
struct Topology {
  std::int64_t euler_characteristic = 0;
  std::uint32_t components = 0;
  std::uint32_t border_loops = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};
std::ostream& operator<<(std::ostream& out, const Topology& topology);

/// Needs an oriented manifold by shared indices.
Topology topology_of(std::span<const Triangle> triangles, std::uint32_t vertex_count);

/// Empty, or what keeps the triangles from being an oriented manifold with border by their indices alone: a
/// triangle that repeats a vertex, an edge walked twice in one direction, a vertex with two fans.
std::string manifold_violation(std::span<const Triangle> triangles, std::uint32_t vertex_count);

/// Undirected border edges, each lower vertex first, sorted.
std::vector<std::pair<VertexId, VertexId>> border_edges(std::span<const Triangle> triangles);

/// Largest distance from a point to the nearest triangle.
double farthest_from(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                     std::span<const Vec3> positions);

/// A box with a thin handle like a suitcase's, as Fig. 3.18: of unit cells, closed, genus 1. The handle is
/// one cell thick.
TriangleSoup box_with_handle();

/// A lamp as Fig. 3.17: a foot, a thin pole, and a shade that is an open sheet with two round borders, the
/// wide one last in `positions`, `around` points each.
TriangleSoup lamp(int around);

}  // namespace selvage
