// SPDX-License-Identifier: MIT
//
// The triangles around each vertex of a soup, and a colour for each vertex that depends on nothing but how
// its surroundings are connected. Both hold for any soup, manifold or not.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// One triangle as one of its vertices sees it: the other two, in the triangle's own direction.
struct Spoke {
  VertexId next, third;
  friend auto operator<=>(const Spoke&, const Spoke&) = default;
};

/// Every triangle three times, once at each vertex. Triangles that repeat an index are left out.
class VertexStars {
 public:
  explicit VertexStars(const TriangleSoup& soup);

  /// The triangles at `v`, in the order of `next`, then `third`.
  std::span<const Spoke> at(VertexId v) const {
    return {spokes_.data() + first_spoke_of_vertex_[v], spokes_.data() + first_spoke_of_vertex_[v + 1]};
  }
  /// The triangles that walk the edge from `v` to `next`: a run of at(v).
  std::span<const Spoke> on_edge(VertexId v, VertexId next) const;

  bool is_used(VertexId v) const { return first_spoke_of_vertex_[v] != first_spoke_of_vertex_[v + 1]; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_spoke_of_vertex_.size() - 1); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(spokes_.size() / 3); }
  std::uint32_t count_used() const;

 private:
  std::vector<std::uint32_t> first_spoke_of_vertex_;  // one more than vertices
  std::vector<Spoke> spokes_;
};

/// Colour refinement [Weisfeiler and Leman 1968]: the first colour of a vertex is its number of triangles;
/// each round mixes in the colours around it. Vertices that some renumbering takes to one another always have
/// equal colours; different colours are therefore a proof, equal ones a hint.
using Colours = std::vector<std::uint64_t>;
Colours first_colours(const VertexStars& stars);
Colours refine_colours(const VertexStars& stars, const Colours& colours);

}  // namespace selvage
