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
                         const VertexMeasures& measures, double radius_share) {
  std::vector<float> radius(components.of_vertex.size());
  for (std::size_t v = 0; v < radius.size(); ++v) {
    const double of_component = radius_share * std::sqrt(shapes[components.of_vertex[v]].area);
    radius[v] = static_cast<float>(std::max(of_component, 1.5 * measures.mean_edge[v]));
  }
  return radius;
}

/// The share of the radius in edges.
std::vector<std::uint8_t> sample_spacing(const std::vector<float>& radius, const VertexMeasures& measures,
                                         double share_of_radius) {
  constexpr float kMaxSpacing = 64;  // where edges are tiny beside the component: slivers, coincident points
  std::vector<std::uint8_t> spacing(radius.size(), 1);
  for (std::size_t v = 0; v < radius.size(); ++v) {
    if (!(measures.mean_edge[v] > 0)) continue;
    const float edges =
        std::min(static_cast<float>(share_of_radius) * radius[v] / measures.mean_edge[v], kMaxSpacing);
    spacing[v] = static_cast<std::uint8_t>(std::max(edges, 1.0f));
  }
  return spacing;
}

}  // namespace

HeightField measure_height(const CornerTable& mesh, std::span<const Vec3> positions,
                           const Components& components, std::span<const ComponentShape> shapes,
                           const VertexMeasures& measures, const HeightFieldOptions& options,
                           const ParallelFor& parallel) {
  HeightField field{std::vector<float>(mesh.vertex_count(), 0),
                    radii(components, shapes, measures, options.radius_share)};
  const std::vector<std::uint8_t> spacing = sample_spacing(field.radius, measures, options.sample_spacing);
  const std::vector<VertexId> samples = choose_samples(mesh, spacing);
  const GeodesicTracer tracer(mesh, positions);
  for_each_chunk(parallel, samples.size(), [&](std::size_t begin, std::size_t end) {
    for (VertexId v : std::span(samples).subspan(begin, end - begin)) {
      const double outward = shapes[components.of_vertex[v]].outward;
      const Bending bending = measure_bending(mesh, positions, tracer, v, field.radius[v], outward);
      const double height =
          options.cut_at_ridges ? std::min(bending.least(), -0.5 * bending.greatest()) : bending.least();
      field.kappa[v] = static_cast<float>(height);
    }
  });
  // Half the usual spacing lets neighbouring samples meet. The widest would do no better: a few tiny edges
  // make it 64.
  const double spacing_sum = std::accumulate(spacing.begin(), spacing.end(), 0.0);
  const auto mean_spacing =
      static_cast<int>(spacing_sum / std::max<double>(1, static_cast<double>(spacing.size())));
  spread_from_samples(mesh, samples, mean_spacing / 2 + 1, field.kappa);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corner_of_vertex[v] != kNone && mesh.is_border_vertex(v)) field.kappa[v] = 0;
  }
  return field;
}

}  // namespace selvage
