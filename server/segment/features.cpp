// SPDX-License-Identifier: MIT
#include "server/segment/features.h"

#include <algorithm>
#include <cmath>

#include "server/segment/average_plane.h"
#include "server/segment/chunks.h"
#include "server/segment/curvature.h"

namespace selvage {
namespace {

/// Far above the rounding of doubles, far below what a surface means.
constexpr double kNoise = 1e-9;

double without_noise(double value, double unit) { return std::abs(value) <= kNoise * unit ? 0 : value; }

}  // namespace

Features extract_features(const CornerTable& mesh, std::span<const Vec3> positions,
                          const Components& components, std::span<const ComponentShape> shapes, int rings,
                          const ParallelFor& parallel) {
  const std::size_t count = mesh.vertex_count();
  Features features{std::vector<double>(count), std::vector<double>(count)};
  for_each_chunk(parallel, count, [&](std::size_t begin, std::size_t end) {
    RingWalker walker(mesh);
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<VertexId>(i);
      if (mesh.corner_of_vertex[v] == kNone) continue;
      const Ring ring = walker.walk(v, rings);
      const ComponentShape& shape = shapes[components.of_vertex[v]];
      features.curvature[v] = without_noise(angle_deficit(positions, v, ring), 1);
      features.distance[v] =
          without_noise(signed_distance(positions, v, ring) * shape.outward, std::sqrt(shape.area));
    }
  });
  return features;
}

std::vector<std::uint8_t> find_plateau(const Features& features, const PlateauThresholds& thresholds) {
  std::vector<std::uint8_t> is_plateau(features.curvature.size(), 0);
  if (is_plateau.empty()) return is_plateau;
  const double lowest_curvature = *std::min_element(features.curvature.begin(), features.curvature.end());
  const double lowest_distance = *std::min_element(features.distance.begin(), features.distance.end());
  const double curvature_limit = thresholds.curvature_factor * lowest_curvature;
  const double distance_limit = thresholds.distance_factor * lowest_distance;
  for (std::size_t v = 0; v < is_plateau.size(); ++v) {
    is_plateau[v] = features.curvature[v] < curvature_limit ||
                    (thresholds.use_distance && features.distance[v] < distance_limit);
  }
  return is_plateau;
}

}  // namespace selvage
