// SPDX-License-Identifier: MIT
#include "bench/simplify/melax.h"

#include <algorithm>
#include <set>

#include "common/base/ids.h"

namespace selvage::bench {
namespace {

class Reduction {
 public:
  explicit Reduction(const TriangleSoup& soup)
      : soup_(soup), triangles_at_(soup.positions.size()), left_(soup.triangles.size()) {
    for (TriangleId t = 0; t < soup_.triangles.size(); ++t) {
      normals_.push_back(normal_of(t));
      for (const VertexId v : soup_.triangles[t]) triangles_at_[v].push_back(t);
    }
    best_.resize(soup.positions.size());
    for (VertexId v = 0; v < best_.size(); ++v) price(v);
  }

  TriangleSoup run(std::size_t target) {
    while (left_ > target && !queue_.empty()) collapse(queue_.begin()->second);
    TriangleSoup result{soup_.positions, {}};
    for (const Triangle& t : soup_.triangles) {
      if (t[0] != kNone) result.triangles.push_back(t);
    }
    return result;
  }

 private:
  struct Best {
    double cost = 0;
    VertexId target = kNone;
  };

  Vec3 normal_of(TriangleId t) const {
    const auto& [a, b, c] = soup_.triangles[t];
    return normalised(
        cross(soup_.positions[b] - soup_.positions[a], soup_.positions[c] - soup_.positions[a]));
  }
  bool is_at(TriangleId t, VertexId v) const {
    return std::find(soup_.triangles[t].begin(), soup_.triangles[t].end(), v) != soup_.triangles[t].end();
  }
  std::vector<VertexId> neighbours_of(VertexId u) const {
    std::vector<VertexId> all;
    for (const TriangleId t : triangles_at_[u]) {
      for (const VertexId v : soup_.triangles[t]) {
        if (v != u) all.push_back(v);
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  double cost(VertexId u, VertexId v) const {
    double curvature = 0;
    for (const TriangleId f : triangles_at_[u]) {
      double least = 1;
      for (const TriangleId n : triangles_at_[u]) {
        if (is_at(n, v)) least = std::min(least, (1 - dot(normals_[f], normals_[n])) / 2);
      }
      curvature = std::max(curvature, least);
    }
    return length(soup_.positions[u] - soup_.positions[v]) * curvature;
  }

  void price(VertexId u) {
    if (best_[u].target != kNone) queue_.erase({best_[u].cost, u});
    best_[u] = {};
    for (const VertexId v : neighbours_of(u)) {
      const double c = cost(u, v);
      if (best_[u].target == kNone || c < best_[u].cost) best_[u] = {c, v};
    }
    if (best_[u].target != kNone) queue_.insert({best_[u].cost, u});
  }

  void collapse(VertexId u) {
    const VertexId v = best_[u].target;
    const std::vector<VertexId> ring = neighbours_of(u);
    const std::vector<TriangleId> moved = std::move(triangles_at_[u]);
    triangles_at_[u].clear();
    for (const TriangleId t : moved) {
      if (is_at(t, v)) {
        for (const VertexId w : soup_.triangles[t]) std::erase(triangles_at_[w], t);
        soup_.triangles[t] = {kNone, kNone, kNone};
        --left_;
        continue;
      }
      std::replace(soup_.triangles[t].begin(), soup_.triangles[t].end(), u, v);
      triangles_at_[v].push_back(t);
      normals_[t] = normal_of(t);
    }
    price(u);
    for (const VertexId w : ring) price(w);
  }

  TriangleSoup soup_;
  std::vector<Vec3> normals_;
  std::vector<std::vector<TriangleId>> triangles_at_;
  std::vector<Best> best_;
  std::set<std::pair<double, VertexId>> queue_;
  std::size_t left_;
};

}  // namespace

TriangleSoup melax_reduce(const TriangleSoup& soup, std::size_t target_triangles) {
  return Reduction(soup).run(target_triangles);
}

}  // namespace selvage::bench
