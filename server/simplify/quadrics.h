// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

/// Quadric error [Garland and Heckbert 1997] for half-edge collapses: every vertex carries the sum of the
/// squared distances to the planes of its original triangles, by area, and at the border to planes through
/// the border edges and normal to their triangles, by squared length. For comparison: remembering planes
/// instead of measuring the deviation costs twice the Hausdorff distance at a tenth of the triangles.
class Quadrics {
 public:
  Quadrics(const CornerTable& mesh, std::span<const Vec3> positions);

  /// The error of u and v together if both lie where v is.
  double cost(VertexId u, VertexId v) const;
  /// v inherits from u.
  void collapse(VertexId u, VertexId v);

 private:
  /// x'Ax + 2b'x + c, as A's upper triangle, b, c. Relative to `origin_`, for models far from zero.
  using Quadric = std::array<double, 10>;
  void add_plane(VertexId v, const Vec3& normal, const Vec3& through, double weight);

  std::span<const Vec3> positions_;
  Vec3 origin_;
  std::vector<Quadric> quadric_of_vertex_;
};

}  // namespace selvage
