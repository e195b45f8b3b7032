// SPDX-License-Identifier: MIT
#include "common/mesh/check_corner_table.h"

namespace selvage {
namespace {

tl::unexpected<Error> violated(const std::string& what, std::uint32_t where) {
  return fail(ErrorCode::BadStream, "corner table: " + what + " " + std::to_string(where));
}

Result<void> check_corner(const CornerTable& table, CornerId c) {
  const VertexId v = table.vertex_of_corner[c];
  if (v >= table.vertex_count()) return violated("vertex out of range at corner", c);
  if (v == table.vertex_of_corner[next(c)]) return violated("repeated vertex at corner", c);
  const CornerId across = table.opposite[c];
  if (across == kNone) return {};
  if (across >= table.corner_count()) return violated("opposite out of range at corner", c);
  if (table.opposite[across] != c) return violated("opposite is not mutual at corner", c);
  if (triangle_of(across) == triangle_of(c)) return violated("triangle is its own neighbour at corner", c);
  if (table.vertex(next(c)) != table.vertex(prev(across)) || table.vertex(prev(c)) != table.vertex(next(across))) {
    return violated("opposite corners face different edges at corner", c);
  }
  return {};
}

/// Walks the fan of v and returns its number of triangles, 0 if the walk meets a foreign vertex or never ends.
std::uint32_t fan_size(const CornerTable& table, VertexId v) {
  const CornerId first = table.corner_of_vertex[v];
  std::uint32_t count = 0;
  for (CornerId c = first; c != kNone; c = table.swing_ccw(c)) {
    if (table.vertex(c) != v || count > table.triangle_count()) return 0;
    if (c == first && count > 0) break;
    ++count;
  }
  return count;
}

}  // namespace

Result<void> check_corner_table(const CornerTable& table) {
  if (table.vertex_of_corner.size() % 3 != 0) return violated("corners not a multiple of three:", table.corner_count());
  if (table.opposite.size() != table.vertex_of_corner.size()) return violated("opposites do not match corners:", table.corner_count());
  for (CornerId c = 0; c < table.corner_count(); ++c) {
    if (auto ok = check_corner(table, c); !ok) return ok;
  }
  std::vector<std::uint32_t> corners_at(table.vertex_count(), 0);
  for (VertexId v : table.vertex_of_corner) ++corners_at[v];
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    const CornerId c = table.corner_of_vertex[v];
    if (c == kNone) {
      if (corners_at[v] != 0) return violated("no corner kept for vertex", v);
      continue;
    }
    if (c >= table.corner_count() || table.vertex(c) != v) return violated("wrong corner kept for vertex", v);
    if (fan_size(table, v) != corners_at[v]) return violated("more than one fan, or not its most clockwise corner, at vertex", v);
  }
  return {};
}

}  // namespace selvage
