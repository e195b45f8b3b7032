// SPDX-License-Identifier: MIT
#include "common/mesh/vertex_stars.h"

#include <algorithm>

namespace selvage {
namespace {

bool repeats_an_index(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The finaliser of splitmix64 [Steele, Lea, Flood 2014]: every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

}  // namespace

VertexStars::VertexStars(const TriangleSoup& soup) : first_spoke_of_vertex_(soup.positions.size() + 1, 0) {
  for (const Triangle& t : soup.triangles) {
    if (repeats_an_index(t)) continue;
    for (VertexId v : t) ++first_spoke_of_vertex_[v];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_spoke_of_vertex_) first = sum += first;  // now each the end of its star
  spokes_.resize(sum);
  for (const Triangle& t : soup.triangles) {
    if (repeats_an_index(t)) continue;
    for (int k = 0; k < 3; ++k) spokes_[--first_spoke_of_vertex_[t[k]]] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  for (VertexId v = 0; v < vertex_count(); ++v) {
    std::sort(spokes_.begin() + first_spoke_of_vertex_[v], spokes_.begin() + first_spoke_of_vertex_[v + 1]);
  }
}

std::span<const Spoke> VertexStars::on_edge(VertexId v, VertexId next) const {
  const auto star = at(v);
  const auto is_before = [](const Spoke& spoke, VertexId w) { return spoke.next < w; };
  const auto first = std::lower_bound(star.begin(), star.end(), next, is_before);
  auto last = first;
  while (last != star.end() && last->next == next) ++last;
  return {first, last};
}

std::uint32_t VertexStars::count_used() const {
  std::uint32_t used = 0;
  for (VertexId v = 0; v < vertex_count(); ++v) used += is_used(v);
  return used;
}

Colours first_colours(const VertexStars& stars) {
  Colours colours(stars.vertex_count());
  for (VertexId v = 0; v < stars.vertex_count(); ++v) colours[v] = mix(stars.at(v).size());
  return colours;
}

Colours refine_colours(const VertexStars& stars, const Colours& colours) {
  Colours refined(colours.size());
  for (VertexId v = 0; v < stars.vertex_count(); ++v) {
    std::uint64_t sum = mix(colours[v]);  // a sum, because the triangles around a vertex have no first
    for (const Spoke& spoke : stars.at(v)) sum += mix(colours[spoke.next] + 3 * mix(colours[spoke.third]));
    refined[v] = sum;
  }
  return refined;
}

}  // namespace selvage
