// SPDX-License-Identifier: MIT
//
// The edge-connected sets of interior triangles of a labelling.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

struct Pieces {
  std::vector<std::uint32_t> of_triangle;     ///< kNone for boundary triangles
  std::vector<std::uint32_t> label;           ///< by piece
  std::vector<std::uint32_t> triangle_count;  ///< by piece

  std::uint32_t count() const { return static_cast<std::uint32_t>(label.size()); }
};

/// True if the three vertices share a label other than `no_label`.
inline bool is_interior(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex, TriangleId t,
                        std::uint32_t no_label) {
  const auto [a, b, c] = mesh.triangle(t);
  return label_of_vertex[a] == label_of_vertex[b] && label_of_vertex[b] == label_of_vertex[c] &&
         label_of_vertex[a] != no_label;
}

/// Pieces in the order of their first triangle. Neighbours are those across `opposite`. Linear time.
Pieces find_pieces(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
                   std::uint32_t no_label);

}  // namespace selvage
