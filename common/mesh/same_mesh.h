// SPDX-License-Identifier: MIT
//
// Are two meshes the same, up to the numbering of vertices and the order of triangles? This is what "nothing
// was lost" is judged by, so a "same" is a proof, not a resemblance: a one-to-one map of the vertices in use
// under which the triangles of one are exactly those of the other, each as often, each turned the same way.
#pragma once

#include <cstdint>
#include <string>

#include "common/mesh/triangle_soup.h"

namespace selvage {

struct MeshComparison {
  bool same = false;
  /// True if the search for a vertex map was given up (see compare_meshes). Then `same` is false.
  bool undecided = false;
  /// Model units: the largest distance on any axis between a vertex and its counterpart. 0 unless same.
  double largest_difference = 0;
  std::string difference;  ///< one sentence on the first difference found; empty if same

  /// What was compared: vertices in use, and triangles without those that repeat an index.
  std::uint32_t vertices_a = 0, vertices_b = 0;
  std::uint32_t triangles_a = 0, triangles_b = 0;
  /// Triangles left out of the comparison because they repeat an index.
  std::uint32_t repeated_index_a = 0, repeated_index_b = 0;
};

/// Compares two meshes. A vertex and its counterpart may differ by `tolerance` model units on each axis
/// (inclusive, with a slack of a few roundings; 0 asks for equal coordinates): half a grid step for a mesh
/// that went through the quantiser. Vertices may coincide, or lie closer together than the tolerance; the
/// triangles then decide. Unreferenced vertices and triangles that repeat an index are ignored on both sides.
///
/// Time and memory are linear for meshes whose surroundings and positions tell most vertices apart, which
/// holds for all files we know. Beyond that the search is bounded: a pair of meshes with enormous symmetry
/// inside the tolerance may come back undecided, which counts as not same.
MeshComparison compare_meshes(const TriangleSoup& a, const TriangleSoup& b, double tolerance);

}  // namespace selvage
