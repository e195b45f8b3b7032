// SPDX-License-Identifier: MIT
//
// How well two segmentations of one mesh agree, as the Princeton Segmentation Benchmark measures it [Chen,
// Golovinskiy, Funkhouser 2009]. Labels are by triangle; triangles count alike whatever their size. 0 is
// agreement.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage::bench {

using Labels = std::vector<std::uint32_t>;

/// One minus the Rand index: the share of pairs of triangles on which the two disagree whether they belong
/// together.
double rand_error(const Labels& a, const Labels& b);

/// The mean of the two directional Hamming distances: the share of triangles outside the best matching
/// segment.
double hamming_distance(const Labels& a, const Labels& b);

/// Distances from the cuts of one segmentation to the nearest cut of the other, averaged over cut vertices,
/// both ways added, over the mean distance of the surface to its centroid. Distances run along edges, so they
/// come out somewhat longer than the benchmark's own geodesics.
class CutDiscrepancy {
 public:
  CutDiscrepancy(const CornerTable& mesh, std::span<const Vec3> positions);
  double between(const Labels& a, const Labels& b) const;

 private:
  std::vector<VertexId> cut_of(const Labels& labels) const;
  double one_way(const std::vector<VertexId>& from, const std::vector<VertexId>& to) const;

  const CornerTable& mesh_;
  std::span<const Vec3> positions_;
  double mean_radius_ = 0;
};

}  // namespace selvage::bench
