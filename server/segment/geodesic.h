// SPDX-License-Identifier: MIT
//
// Straightest geodesics: from a vertex straight on over the surface, triangle after triangle unfolded into a
// plane that is turned so that the line is its x axis.
//
// clang-format off
//            b             The line enters a triangle through the edge from a, on its right, to b, on its left.
//           / \            The apex is placed in the plane from its coordinates relative to that edge. If it lies
//     -----/---\--->       left of the line, the line leaves between a and the apex, otherwise between the apex
//         /   apex         and b.
//        a---/
// clang-format on
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// Where a geodesic ended.
struct GeodesicEnd {
  Vec3 way;  ///< from the start to the end, which lies on the surface
  /// Walked; less than asked for if a mesh border, or a limit of 1024 triangles, came first.
  double length = 0;
};

/// Holds, for every corner, what a line needs to know that enters the corner's triangle through the edge it
/// faces: 16 bytes a corner. Thread-safe.
class GeodesicTracer {
 public:
  /// Memory to use again from vertex to vertex.
  struct Scratch;

  /// Both must outlive the tracer.
  GeodesicTracer(const CornerTable& mesh, std::span<const Vec3> positions, const ParallelFor& parallel);

  /// Walks `length` (model units) from `v`, which has triangles, in n = ends.size() directions: with Theta
  /// the angle of all triangles at v, the j-th is at (j + 1/2) Theta / n counter-clockwise of the edge from
  /// corner_of_vertex[v] to its next corner. All lines advance together, which hides the time that each step
  /// of one waits for the step before.
  void shoot(VertexId v, double length, Scratch& scratch, std::span<GeodesicEnd> ends) const;

 private:
  struct Entry {
    /// The apex in the frame whose origin is the edge's left end (vertex(next(c))), and whose unit and x axis
    /// is the edge to its right end; it lies on the side of positive y.
    float x, y;
    CornerId on_left, on_right;  ///< which corner a line enters next that has the apex there
  };
  class Lines;

  Entry make_entry(CornerId c) const;

  const CornerTable& mesh_;
  std::span<const Vec3> positions_;
  std::unique_ptr<Entry[]> entry_of_corner_;
};

/// One of the triangles at the start, laid into the plane with the start at 0 and its next corner on the x
/// axis.
struct UnfoldedAtStart {
  CornerId corner = kNone;
  double end_angle = 0;  ///< radians, all triangles before it included
  double next_x = 0;     ///< model units
  double prev_x = 0, prev_y = 0;
};

struct GeodesicTracer::Scratch {
  std::vector<UnfoldedAtStart> fan;
};

}  // namespace selvage
