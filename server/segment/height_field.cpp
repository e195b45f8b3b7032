// SPDX-License-Identifier: MIT
#include "server/segment/height_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "server/segment/bending.h"
#include "server/segment/chunks.h"
#include "server/segment/geodesic.h"
#include "server/segment/samples.h"

namespace selvage {
namespace {

std::vector<float> radii(const Components& components, std::span<const ComponentShape> shapes,
                         const VertexMeasures& measures, double radius_share, const ParallelFor& parallel) {
  std::vector<float> radius(components.of_vertex.size());
  for_each_chunk(parallel, radius.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const double of_component = radius_share * std::sqrt(shapes[components.of_vertex[v]].area);
      radius[v] = static_cast<float>(std::max(of_component, 1.5 * measures.mean_edge[v]));
    }
  });
  return radius;
}

/// The share of the radius in edges, rounded down but from three quarters on: thin limbs suffer from more.
std::vector<std::uint8_t> sample_spacing(const std::vector<float>& radius, const VertexMeasures& measures,
                                         double share_of_radius, const ParallelFor& parallel) {
  constexpr float kMaxSpacing = 64;  // where edges are tiny beside the component: slivers, coincident points
  std::vector<std::uint8_t> spacing(radius.size(), 1);
  for_each_chunk(parallel, radius.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (!(measures.mean_edge[v] > 0)) continue;
      const float edges = static_cast<float>(share_of_radius) * radius[v] / measures.mean_edge[v];
      spacing[v] = static_cast<std::uint8_t>(std::clamp(edges + 0.25f, 1.0f, kMaxSpacing));
    }
  });
  return spacing;
}

/// Half the usual spacing lets neighbouring samples meet. The widest would do no better: a few tiny edges
/// make it 64.
int count_sweeps(const std::vector<std::uint8_t>& spacing) {
  if (spacing.empty()) return 0;
  return static_cast<int>(std::accumulate(spacing.begin(), spacing.end(), std::size_t{0}) / spacing.size()) /
             2 +
         1;
}

}  // namespace

HeightField measure_height(const CornerTable& mesh, const Neighbours& neighbours,
                           std::span<const Vec3> positions, const Components& components,
                           std::span<const ComponentShape> shapes, const VertexMeasures& measures,
                           const HeightFieldOptions& options, const ParallelFor& parallel) {
  HeightField field{std::vector<float>(mesh.vertex_count(), 0),
                    radii(components, shapes, measures, options.radius_share, parallel)};
  const std::vector<std::uint8_t> spacing =
      sample_spacing(field.radius, measures, options.sample_spacing, parallel);
  const Samples samples = choose_samples(mesh, neighbours, spacing, parallel);
  const GeodesicTracer tracer(mesh, positions, parallel);
  for_each_chunk(parallel, samples.vertices.size(), [&](std::size_t begin, std::size_t end) {
    GeodesicTracer::Scratch scratch;
    for (VertexId v : std::span(samples.vertices).subspan(begin, end - begin)) {
      const double outward = shapes[components.of_vertex[v]].outward;
      const Bending bending = measure_bending(mesh, tracer, v, field.radius[v], outward, scratch);
      const double height =
          options.cut_at_ridges ? std::min(bending.least(), -0.5 * bending.greatest()) : bending.least();
      field.kappa[v] = static_cast<float>(height);
    }
  });
  spread_from_samples(neighbours, samples, count_sweeps(spacing), field.kappa, parallel);
  for_each_chunk(parallel, field.kappa.size(), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      if (mesh.corner_of_vertex[v] != kNone && mesh.is_border_vertex(v)) field.kappa[v] = 0;
    }
  });
  return field;
}

}  // namespace selvage
