// SPDX-License-Identifier: MIT
//
// Straightest geodesics: from a vertex straight on over the surface, triangle after triangle unfolded into
// the plane of the first.
//
//                 C          The line leaves (third, a, b) through the edge a-b. C, the next triangle's apex,
//                 is
//               /   \        placed in the plane from its coordinates relative to that edge. If C lies left
//               of the
//         b ---+-----+- a    line, it leaves through a-C, otherwise through C-b.
//           \     |    /
//            \    |   /
//              third
#pragma once

#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// Where a geodesic ended.
struct GeodesicEnd {
  Vec3 point;  ///< on the surface
  double length =
      0;  ///< walked; less than asked for if a mesh border, or a limit of 1024 triangles, came first
};

/// Holds, for every corner, what lies beyond the edge it faces: 12 bytes a corner. Thread-safe.
class GeodesicTracer {
 public:
  /// Both must outlive the tracer.
  GeodesicTracer(const CornerTable& mesh, std::span<const Vec3> positions);

  /// Walks `length` (model units) from the vertex of corner `start` into its triangle, `angle` radians
  /// counter-clockwise of the edge to the next corner, 0 <= angle <= the corner's angle.
  GeodesicEnd trace(CornerId start, double angle, double length) const;

 private:
  /// The opposite corner, and its place in the frame whose origin is the far end of the edge
  /// (vertex(prev(c))) and whose unit and x axis is the edge back to vertex(next(c)); it lies on the side of
  /// positive y.
  struct Beyond {
    CornerId corner = kNone;
    float x = 0, y = 0;
  };

  const CornerTable& mesh_;
  std::span<const Vec3> positions_;
  std::vector<Beyond> beyond_corner_;  // together, since a step of a walk needs all of it and nothing else
};

}  // namespace selvage
