// SPDX-License-Identifier: MIT
#include "common/mesh/same_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "common/mesh/vertex_matching.h"
#include "common/mesh/vertex_stars.h"

namespace selvage {
namespace {

/// Three rounds tell apart nearly all vertices of an irregular mesh; more cost time and give little.
constexpr int kColourRounds = 3;

std::string describe(VertexId v, const Vec3& p) {
  char text[120];
  std::snprintf(text, sizeof text, "vertex %u at (%.9g, %.9g, %.9g)", v, p.x, p.y, p.z);
  return text;
}

std::string count_difference(const char* what, std::uint32_t a, std::uint32_t b) {
  return "the first mesh has " + std::to_string(a) + " " + what + ", the second " + std::to_string(b);
}

/// The colours of the vertices in use, sorted.
Colours sorted_colours(const VertexStars& stars, const Colours& colours) {
  Colours used;
  used.reserve(colours.size());
  for (VertexId v = 0; v < stars.vertex_count(); ++v)
    if (stars.is_used(v)) used.push_back(colours[v]);
  std::ranges::sort(used);
  return used;
}

/// The lowest vertex whose colour is more frequent here than there; kNone if there is none.
VertexId first_surplus(const VertexStars& stars, const Colours& colours, const Colours& here,
                       const Colours& there) {
  Colours surplus;
  std::ranges::set_difference(here, there, std::back_inserter(surplus));
  for (VertexId v = 0; v < stars.vertex_count(); ++v)
    if (stars.is_used(v) && std::ranges::binary_search(surplus, colours[v])) return v;
  return kNone;
}

/// Refines both meshes' colours in step. Returns a vertex of `a` whose surroundings occur less often in `b`,
/// as soon as a round shows one: early rounds look at few triangles, so the vertex is beside the difference.
VertexId colour_both(const VertexStars& a, const VertexStars& b, Colours& colours_a, Colours& colours_b) {
  colours_a = first_colours(a);
  colours_b = first_colours(b);
  for (int round = 0;; ++round) {
    const Colours here = sorted_colours(a, colours_a), there = sorted_colours(b, colours_b);
    if (here != there) return first_surplus(a, colours_a, here, there);
    if (round == kColourRounds) return kNone;
    colours_a = refine_colours(a, colours_a);
    colours_b = refine_colours(b, colours_b);
  }
}

/// The proof: `image` is one-to-one by construction, so the meshes are the same exactly if every star is
/// carried to the star of the image. Returns the first vertex where it is not, or kNone.
VertexId first_wrong_star(const VertexStars& a, const VertexStars& b, std::span<const VertexId> image) {
  std::vector<Spoke> carried;
  for (VertexId v = 0; v < a.vertex_count(); ++v) {
    carried.clear();
    for (const Spoke& s : a.at(v)) carried.push_back({image[s.next], image[s.third]});
    std::ranges::sort(carried);
    if (!carried.empty() && !std::ranges::equal(carried, b.at(image[v]))) return v;
  }
  return kNone;
}

double largest_distance(const TriangleSoup& a, const TriangleSoup& b, std::span<const VertexId> image) {
  double largest = 0;
  for (VertexId v = 0; v < image.size(); ++v) {
    if (image[v] == kNone) continue;
    const Vec3 d = a.positions[v] - b.positions[image[v]];
    largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  return largest;
}

std::string describe_failure(const TriangleSoup& a, const VertexMatching& matching, double tolerance) {
  const VertexId v = matching.culprit;
  const std::string where = describe(v, a.positions[v]) + " of the first mesh";
  if (matching.verdict == VertexMatching::Verdict::Undecided)
    return "gave up looking for a counterpart of " + where +
           ": too many vertices are alike within the tolerance";
  if (matching.culprit_has_candidates)
    return "the triangles around " + where + " are not found in the second";
  char reach[40];
  std::snprintf(reach, sizeof reach, "%.9g", tolerance);
  return std::string("no vertex of the second mesh with like surroundings lies within ") + reach + " of " +
         where;
}

}  // namespace

MeshComparison compare_meshes(const TriangleSoup& a, const TriangleSoup& b, double tolerance) {
  const VertexStars stars_a(a), stars_b(b);
  MeshComparison result;
  result.vertices_a = stars_a.count_used(), result.vertices_b = stars_b.count_used();
  result.triangles_a = stars_a.triangle_count(), result.triangles_b = stars_b.triangle_count();
  result.repeated_index_a = static_cast<std::uint32_t>(a.triangles.size()) - result.triangles_a;
  result.repeated_index_b = static_cast<std::uint32_t>(b.triangles.size()) - result.triangles_b;

  const auto differs = [&](std::string sentence) {
    result.difference = std::move(sentence);
    return result;
  };
  if (result.triangles_a != result.triangles_b)
    return differs(count_difference("triangles", result.triangles_a, result.triangles_b));
  if (result.vertices_a != result.vertices_b)
    return differs(count_difference("vertices in use", result.vertices_a, result.vertices_b));

  Colours colours_a, colours_b;
  const VertexId odd = colour_both(stars_a, stars_b, colours_a, colours_b);
  if (odd != kNone)
    return differs("the triangles around " + describe(odd, a.positions[odd]) +
                   " of the first mesh are not found in the second");

  const VertexMatching matching =
      match_vertices({a.positions, stars_a, colours_a}, {b.positions, stars_b, colours_b}, tolerance);
  result.undecided = matching.verdict == VertexMatching::Verdict::Undecided;
  if (matching.verdict != VertexMatching::Verdict::Found)
    return differs(describe_failure(a, matching, tolerance));
  const VertexId wrong = first_wrong_star(stars_a, stars_b, matching.image_of_vertex);
  if (wrong != kNone)
    return differs("the triangles around " + describe(wrong, a.positions[wrong]) +
                   " of the first mesh are not found in the second");

  result.same = true;
  result.largest_difference = largest_distance(a, b, matching.image_of_vertex);
  return result;
}

}  // namespace selvage
