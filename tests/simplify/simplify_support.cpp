// SPDX-License-Identifier: MIT
#include "tests/simplify/simplify_support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <set>

#include "common/base/disjoint_sets.h"
#include "common/mesh/boundary_loops.h"
#include "common/mesh/check_corner_table.h"
#include "server/simplify/point_triangle.h"
#include "tests/support/lathe.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

using Cell = std::array<int, 3>;

/// The surface of cells that meet in faces only.
TriangleSoup surface_of(const std::set<Cell>& cells) {
  TriangleSoup soup;
  std::map<Cell, VertexId> vertex_at;
  const auto vertex = [&](const Cell& at) {
    const auto [it, is_new] = vertex_at.try_emplace(at, static_cast<VertexId>(soup.positions.size()));
    if (is_new) soup.positions.push_back({double(at[0]), double(at[1]), double(at[2])});
    return it->second;
  };
  for (const Cell& cell : cells) {
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2, side = face % 2;
      Cell beyond = cell;
      beyond[axis] += side == 1 ? 1 : -1;
      if (cells.contains(beyond)) continue;
      std::array<VertexId, 4> ring;
      for (int k = 0; k < 4; ++k) {
        Cell at = cell;
        at[axis] += side;
        at[(axis + 1) % 3] += k == 1 || k == 2;
        at[(axis + 2) % 3] += k >= 2;
        ring[side == 1 ? k : 3 - k] = vertex(at);
      }
      soup.triangles.push_back({ring[0], ring[1], ring[2]});
      soup.triangles.push_back({ring[0], ring[2], ring[3]});
    }
  }
  return soup;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Topology& t) {
  return out << "Euler characteristic " << t.euler_characteristic << ", " << t.components << " components, "
             << t.border_loops << " border loops";
}

Topology topology_of(std::span<const Triangle> triangles, std::uint32_t vertex_count) {
  const CornerTable table = build_corner_table(triangles, vertex_count);
  Topology topology;
  DisjointSets sets(vertex_count);
  std::int64_t sides = 0, border = 0;
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    sets.merge(table.vertex(c), table.vertex(next(c)));
    ++sides;
    border += table.opposite[c] == kNone;
  }
  for (VertexId v = 0; v < vertex_count; ++v) {
    if (table.corner_of_vertex[v] == kNone) continue;
    ++topology.euler_characteristic;
    topology.components += sets.set_of(v) == v;
  }
  topology.euler_characteristic += std::int64_t(triangles.size()) - (sides + border) / 2;
  topology.border_loops = static_cast<std::uint32_t>(find_boundary_loops(table).lengths.size());
  return topology;
}

std::string manifold_violation(std::span<const Triangle> triangles, std::uint32_t vertex_count) {
  std::set<std::pair<VertexId, VertexId>> walked;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] == t[(k + 1) % 3]) return "a triangle repeats vertex " + std::to_string(t[k]);
      if (!walked.emplace(t[k], t[(k + 1) % 3]).second) {
        return "walked twice: " + std::to_string(t[k]) + " to " + std::to_string(t[(k + 1) % 3]);
      }
    }
  }
  const auto ok = check_corner_table(build_corner_table(triangles, vertex_count));
  return ok ? "" : ok.error().message;
}

std::vector<std::pair<VertexId, VertexId>> border_edges(std::span<const Triangle> triangles) {
  std::set<std::pair<VertexId, VertexId>> walked, border;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) walked.emplace(t[k], t[(k + 1) % 3]);
  }
  for (const auto& [a, b] : walked) {
    if (!walked.contains({b, a})) border.insert(std::minmax(a, b));
  }
  return {border.begin(), border.end()};
}

double farthest_from(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                     std::span<const Vec3> positions) {
  std::vector<PreparedTriangle> prepared;
  for (const auto& [a, b, c] : triangles) prepared.emplace_back(positions[a], positions[b], positions[c]);
  double farthest = 0;
  for (const Vec3& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const PreparedTriangle& triangle : prepared) least = std::min(least, triangle.squared_distance(p));
    farthest = std::max(farthest, least);
  }
  return std::sqrt(farthest);
}

TriangleSoup box_with_handle() {
  std::set<Cell> cells;
  for (int x = 0; x < 24; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 10; ++z) cells.insert({x, y, z});
  for (int z = 10; z < 16; ++z) cells.insert({{4, 6, z}}), cells.insert({{19, 6, z}});
  for (int x = 4; x < 20; ++x) cells.insert({x, 6, 15});
  return surface_of(cells);
}

TriangleSoup lamp(int around) {
  const std::vector<shapes::ProfilePoint> profile = {{0, 0},    {3, 0},     {3, 0.5},
                                                     {0.25, 1}, {0.25, 10}, {0, 10}};
  TriangleSoup soup = shapes::lathe(profile, 0.4);
  TriangleSoup shade = shapes::open_cylinder(around, 12);
  // From radius 2 on top to 5 below, z from 11 to 6, so that the wide border comes last.
  for (Vec3& p : shade.positions) {
    const double down = p.z / 12, radius = 2 + 3 * down;
    p = {radius * p.x, -radius * p.y, 11 - 5 * down};  // mirrored twice: still oriented outwards
  }
  shapes::append(soup, shade);
  return soup;
}

}  // namespace selvage
