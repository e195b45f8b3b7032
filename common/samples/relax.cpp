// SPDX-License-Identifier: MIT
#include "common/samples/relax.h"

#include <cmath>
#include <vector>

#include "common/samples/flip_edges.h"

namespace selvage {
namespace {

constexpr int kRounds = 6;
constexpr double kStep = 0.6;  // of the way to the middle of the neighbours

std::vector<Vec3> middles_of_neighbours(const TriangleSoup& soup) {
  std::vector<Vec3> sum(soup.positions.size());
  std::vector<int> count(soup.positions.size());
  for (const Triangle& t : soup.triangles) {
    for (int k = 0; k < 3; ++k) {
      sum[t[k]] += soup.positions[t[(k + 1) % 3]];  // each neighbour once: the mesh is closed
      ++count[t[k]];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = count[v] > 0 ? sum[v] * (1.0 / count[v]) : soup.positions[v];
  return sum;
}

double mean_edge(const TriangleSoup& soup) {
  double sum = 0;
  for (const Triangle& t : soup.triangles) sum += length(soup.positions[t[0]] - soup.positions[t[1]]);
  return soup.triangles.empty() ? 1 : sum / static_cast<double>(soup.triangles.size());
}

/// One Newton step towards the surface, no longer than `reach`.
Vec3 towards_surface(const Vec3& p, Solid solid, double reach) {
  const double e = 0.01 * reach, f = solid(p);
  const Vec3 gradient =
      Vec3{solid({p.x + e, p.y, p.z}) - f, solid({p.x, p.y + e, p.z}) - f, solid({p.x, p.y, p.z + e}) - f} *
      (1 / e);
  const Vec3 step = gradient * (-f / std::max(dot(gradient, gradient), 0.1));
  const double size = length(step);
  return p + (size > reach ? step * (reach / size) : step);
}

}  // namespace

void relax_on_surface(TriangleSoup& soup, Solid solid) {
  const double edge = mean_edge(soup);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vec3> middles = middles_of_neighbours(soup);
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
      const Vec3 p = soup.positions[v] + (middles[v] - soup.positions[v]) * kStep;
      soup.positions[v] = towards_surface(p, solid, 0.5 * edge);
    }
    if (round % 2 == 1) flip_to_delaunay(soup);
  }
}

}  // namespace selvage
