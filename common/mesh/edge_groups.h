// SPDX-License-Identifier: MIT
//
// The undirected edges of a triangle list, each with the triangles at it: the step that every way of building
// connectivity starts with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// A corner stands for the side of its triangle that it faces. The sides of an edge come in the order of
/// their corners, edges in the order of their lower, then higher vertex.
class EdgeGroups {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(end_of_edge_.size()); }
  std::span<const CornerId> operator[](std::uint32_t edge) const {
    const std::uint32_t start = edge == 0 ? 0 : end_of_edge_[edge - 1];
    return std::span(sides_).subspan(start, end_of_edge_[edge] - start);
  }

 private:
  friend EdgeGroups group_edges(std::span<const Triangle> triangles, std::uint32_t vertex_count);

  std::vector<CornerId> sides_;
  std::vector<std::uint32_t> end_of_edge_;
};

/// Linear time, but for sorting the edges around a vertex. Needs indices below `vertex_count`.
EdgeGroups group_edges(std::span<const Triangle> triangles, std::uint32_t vertex_count);

}  // namespace selvage
