// SPDX-License-Identifier: MIT
#include "server/segment/samples.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "server/segment/chunks.h"

namespace selvage {
namespace {

constexpr std::uint8_t kFar = std::numeric_limits<std::uint8_t>::max();

/// What each vertex knows of the samples so far.
struct Coverage {
  std::vector<std::uint8_t> edges_to_nearest;  // kFar: not covered
  std::vector<VertexId> nearest;
};

/// Consecutive vertices [begin, end).
struct Slice {
  VertexId begin = 0, end = 0;
  bool has(VertexId v) const { return begin <= v && v < end; }
};

std::vector<Slice> cut_in(std::size_t count, VertexId vertex_count) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < count; ++i) {
    slices.push_back({static_cast<VertexId>(vertex_count * i / count),
                      static_cast<VertexId>(vertex_count * (i + 1) / count)});
  }
  return slices;
}

/// Slices that can choose samples on their own: long runs of vertices with few edges between them. One if the
/// vertex order has no regard to place; slices of such an order would see no neighbours to cover.
std::vector<Slice> choose_slices(const Neighbours& neighbours, const ParallelFor& parallel) {
  constexpr std::size_t kMaxSlices = 32, kMinVertices = 4096;
  constexpr double kMaxShareAcross = 0.25;
  const VertexId vertices = neighbours.vertex_count();
  std::vector<Slice> slices =
      cut_in(std::clamp<std::size_t>(vertices / kMinVertices, 1, kMaxSlices), vertices);
  std::vector<std::size_t> across(slices.size(), 0), edges(slices.size(), 0);
  parallel(slices.size(), [&](std::size_t i) {
    for (VertexId v = slices[i].begin; v < slices[i].end; ++v) {
      for (VertexId u : neighbours[v]) across[i] += !slices[i].has(u);
      edges[i] += neighbours[v].size();
    }
  });
  const auto sum = [](const std::vector<std::size_t>& counts) {
    return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  };
  return sum(across) <= kMaxShareAcross * sum(edges) ? slices : cut_in(1, vertices);
}

/// Covers what lies in the slice and within `reach` edges of `centre`, as far as no other sample is as near.
void cover(const Neighbours& neighbours, const Slice& slice, VertexId centre, int reach, Coverage& coverage,
           std::vector<VertexId>& disc) {
  coverage.edges_to_nearest[centre] = 0;
  coverage.nearest[centre] = centre;
  disc.assign(1, centre);
  std::size_t at = 0;
  for (int step = 1; step <= reach; ++step) {
    for (const std::size_t end = disc.size(); at < end; ++at) {
      for (VertexId u : neighbours[disc[at]]) {
        if (!slice.has(u) || coverage.edges_to_nearest[u] <= step) continue;
        coverage.edges_to_nearest[u] = static_cast<std::uint8_t>(step);
        coverage.nearest[u] = centre;
        disc.push_back(u);
      }
    }
  }
}

}  // namespace

Samples choose_samples(const CornerTable& mesh, const Neighbours& neighbours,
                       std::span<const std::uint8_t> spacing_of_vertex, const ParallelFor& parallel) {
  Coverage coverage{std::vector<std::uint8_t>(mesh.vertex_count(), kFar),
                    std::vector<VertexId>(mesh.vertex_count(), kNone)};
  const std::vector<Slice> slices = choose_slices(neighbours, parallel);
  std::vector<std::vector<VertexId>> chosen(slices.size());
  parallel(slices.size(), [&](std::size_t i) {
    std::vector<VertexId> disc;
    for (VertexId v = slices[i].begin; v < slices[i].end; ++v) {
      if (spacing_of_vertex[v] > 1 && coverage.edges_to_nearest[v] != kFar) continue;
      if (mesh.corner_of_vertex[v] == kNone || mesh.is_border_vertex(v)) continue;
      chosen[i].push_back(v);
      cover(neighbours, slices[i], v, spacing_of_vertex[v] - 1, coverage, disc);
    }
  });
  Samples samples{{}, std::move(coverage.nearest)};
  for (const std::vector<VertexId>& of_slice : chosen)
    samples.vertices.insert(samples.vertices.end(), of_slice.begin(), of_slice.end());
  return samples;
}

void spread_from_samples(const Neighbours& neighbours, const Samples& samples, int sweeps,
                         std::vector<float>& value_of_vertex, const ParallelFor& parallel) {
  const std::vector<VertexId>& nearest = samples.nearest_of_vertex;
  if (samples.vertices.size() == nearest.size()) return;
  const auto sample_of = [&](VertexId v) {
    if (nearest[v] != kNone) return nearest[v];
    for (VertexId u : neighbours[v]) {
      if (nearest[u] != kNone) return nearest[u];
    }
    return kNone;
  };
  for_each_chunk(parallel, nearest.size(), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      const VertexId sample = sample_of(v);
      if (sample != v && sample != kNone) value_of_vertex[v] = value_of_vertex[sample];
    }
  });
  std::vector<float> mean(nearest.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for_each_chunk(parallel, nearest.size(), [&](std::size_t begin, std::size_t end) {
      for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
        mean[v] = value_of_vertex[v];
        if (nearest[v] == v) continue;
        for (VertexId u : neighbours[v]) mean[v] += value_of_vertex[u];
        mean[v] /= static_cast<float>(neighbours[v].size() + 1);
      }
    });
    mean.swap(value_of_vertex);
  }
}

}  // namespace selvage
