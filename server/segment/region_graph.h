// SPDX-License-Identifier: MIT
//
// Regions and their common borders as a graph that can be contracted: what every kind of region merging
// works on. The dissertation keeps an Nr x Nr matrix (Table 4.3); neighbour maps need memory for real borders
// only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/mesh/corner_table.h"

namespace selvage {

/// What two neighbouring regions share. All but `edges` are sums or minima of what the caller measures.
struct RegionBorder {
  std::uint32_t edges = 0;  ///< mesh edges with one end in each: the dissertation's boundary length
  double length = 0;        ///< model units
  double concavity = 0;     ///< integrated along the border: dimensionless times model units
  double pass = std::numeric_limits<double>::infinity();  ///< height of the lowest edge across

  RegionBorder& operator+=(const RegionBorder& other) {
    edges += other.edges;
    length += other.length;
    concavity += other.concavity;
    pass = std::min(pass, other.pass);
    return *this;
  }
};

/// What one edge adds to the border of the regions at its ends; `c` is a corner that faces it.
using MeasureEdge = std::function<RegionBorder(CornerId c)>;

/// Nodes are 0..size-1, at first one a label. Merging keeps one of the two nodes; find() tells which node a
/// label has become part of. All merges of B regions together take O(E log B), E being the number of borders.
class RegionGraph {
 public:
  using Neighbours = std::unordered_map<std::uint32_t, RegionBorder>;

  /// Regions are the vertices of equal label; labels are 0..region_count-1. Without `measure` only edges
  /// count.
  RegionGraph(const CornerTable& mesh, std::span<const std::uint32_t> label_of_vertex,
              std::uint32_t region_count, const MeasureEdge& measure = {});

  std::uint32_t size() const { return static_cast<std::uint32_t>(neighbours_.size()); }
  /// The surviving node that holds `node`.
  std::uint32_t find(std::uint32_t node) const;
  /// Of a surviving node. Iterate it only for results that do not depend on the order.
  const Neighbours& neighbours(std::uint32_t node) const { return neighbours_[node]; }
  std::uint32_t vertex_count(std::uint32_t node) const { return vertex_count_[node]; }

  /// Joins two different surviving nodes and returns the one that survives: that with more neighbours, the
  /// lower id if they have as many.
  std::uint32_t merge(std::uint32_t a, std::uint32_t b);

  /// Replaces each label by a number 0..n-1 of its surviving node, in the order of first vertices. Returns n.
  std::uint32_t relabel(std::span<std::uint32_t> label_of_vertex) const;

 private:
  mutable std::vector<std::uint32_t> parent_;  // union-find, halved on the way
  std::vector<Neighbours> neighbours_;
  std::vector<std::uint32_t> vertex_count_;
};

}  // namespace selvage
