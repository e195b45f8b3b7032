// SPDX-License-Identifier: MIT
#include "bench/segment/scores.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "server/segment/one_ring.h"

namespace selvage::bench {
namespace {

struct Overlap {
  std::uint32_t a, b;
  double count;
};

/// The non-empty cells of the contingency table, sorted by a.
std::vector<Overlap> overlaps_of(const Labels& a, const Labels& b) {
  std::vector<std::uint64_t> pairs(a.size());
  for (std::size_t t = 0; t < a.size(); ++t) pairs[t] = std::uint64_t{a[t]} << 32 | b[t];
  std::sort(pairs.begin(), pairs.end());
  std::vector<Overlap> overlaps;
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
    while (end < pairs.size() && pairs[end] == pairs[begin]) ++end;
    overlaps.push_back({static_cast<std::uint32_t>(pairs[begin] >> 32),
                        static_cast<std::uint32_t>(pairs[begin]), static_cast<double>(end - begin)});
  }
  return overlaps;
}

double pairs_in(double count) { return count * (count - 1) / 2; }

/// Pairs inside one segment, summed over segments.
double pairs_together(Labels labels) {
  std::sort(labels.begin(), labels.end());
  double sum = 0;
  for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
    while (end < labels.size() && labels[end] == labels[begin]) ++end;
    sum += pairs_in(static_cast<double>(end - begin));
  }
  return sum;
}

/// The share of triangles of `a`'s segments outside the segment of `b` that overlaps each most.
double directional_hamming(const Labels& a, const Labels& b) {
  double matched = 0, best = 0;
  const auto overlaps = overlaps_of(a, b);
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    best = std::max(best, overlaps[i].count);
    if (i + 1 == overlaps.size() || overlaps[i + 1].a != overlaps[i].a) matched += std::exchange(best, 0);
  }
  return 1 - matched / static_cast<double>(a.size());
}

}  // namespace

double rand_error(const Labels& a, const Labels& b) {
  double both = 0;
  for (const Overlap& overlap : overlaps_of(a, b)) both += pairs_in(overlap.count);
  return (pairs_together(a) + pairs_together(b) - 2 * both) / pairs_in(static_cast<double>(a.size()));
}

double hamming_distance(const Labels& a, const Labels& b) {
  return 0.5 * (directional_hamming(a, b) + directional_hamming(b, a));
}

CutDiscrepancy::CutDiscrepancy(const CornerTable& mesh, std::span<const Vec3> positions)
    : mesh_(mesh), positions_(positions) {
  Vec3 centroid;
  double area_sum = 0, radius_sum = 0;
  const auto for_each_triangle = [&](auto&& visit) {
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
      const auto [i, j, k] = mesh.triangle(t);
      visit((positions[i] + positions[j] + positions[k]) * (1.0 / 3),
            0.5 * length(cross(positions[j] - positions[i], positions[k] - positions[i])));
    }
  };
  for_each_triangle([&](const Vec3& middle, double area) { centroid += middle * area, area_sum += area; });
  centroid = centroid * (1 / area_sum);
  for_each_triangle([&](const Vec3& middle, double area) { radius_sum += length(middle - centroid) * area; });
  mean_radius_ = radius_sum / area_sum;
}

std::vector<VertexId> CutDiscrepancy::cut_of(const Labels& labels) const {
  std::vector<VertexId> cut;
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
    const std::uint32_t first = labels[triangle_of(mesh_.corner_of_vertex[v])];
    bool is_cut = false;
    for_each_corner_at(mesh_, v, [&](CornerId c) { is_cut |= labels[triangle_of(c)] != first; });
    if (is_cut) cut.push_back(v);
  }
  return cut;
}

double CutDiscrepancy::one_way(const std::vector<VertexId>& from, const std::vector<VertexId>& to) const {
  if (from.empty()) return 0;
  if (to.empty()) return mean_radius_;  // nothing to measure to
  std::vector<double> distance(mesh_.vertex_count(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (VertexId v : to) distance[v] = 0, queue.push({0, v});
  while (!queue.empty()) {
    const auto [reached, v] = queue.top();
    queue.pop();
    if (reached > distance[v]) continue;
    for_each_neighbour(mesh_, v, [&](VertexId u) {
      const double candidate = reached + length(positions_[u] - positions_[v]);
      if (candidate < distance[u]) distance[u] = candidate, queue.push({candidate, u});
    });
  }
  double sum = 0;
  for (VertexId v : from) sum += distance[v];
  return sum / static_cast<double>(from.size());
}

double CutDiscrepancy::between(const Labels& a, const Labels& b) const {
  const auto cut_a = cut_of(a), cut_b = cut_of(b);
  return (one_way(cut_a, cut_b) + one_way(cut_b, cut_a)) / mean_radius_;
}

}  // namespace selvage::bench
