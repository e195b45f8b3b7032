// SPDX-License-Identifier: MIT
#include "bench/simplify/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/simplify/metro.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"

namespace selvage::bench {

bool load(const std::string& path, BenchMesh& mesh) {
  auto file = read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().to_string().c_str()), false;
  auto repaired = repair(file->soup);
  if (!repaired)
    return std::fprintf(stderr, "%s: %s\n", path.c_str(), repaired.error().message.c_str()), false;
  RepairedMesh ordered = spatially_ordered(std::move(*repaired));
  mesh.name = path.substr(path.find_last_of('/') + 1);
  mesh.soup.positions = std::move(ordered.positions);
  for (TriangleId t = 0; t < ordered.table.triangle_count(); ++t) {
    mesh.soup.triangles.push_back(ordered.table.triangle(t));
  }
  mesh.table = std::move(ordered.table);
  return true;
}

Figures measure(const Simplifier& simplifier, const BenchMesh& mesh, double ratio, int repeats) {
  const auto target = static_cast<std::size_t>(ratio * double(mesh.soup.triangles.size()));
  Figures figures;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Outcome outcome = simplifier.run(mesh, target);
    figures.seconds = repeat == 0 ? outcome.seconds : std::min(figures.seconds, outcome.seconds);
    if (repeat > 0) continue;
    figures.triangles = outcome.soup.triangles.size();
    figures.megabytes = double(outcome.working_bytes) / (1 << 20);
    const SurfaceDistance distance = surface_distance(mesh.soup, outcome.soup);
    const double percent = 100 / diagonal_of(mesh.soup);
    figures.hausdorff = distance.largest * percent;
    figures.mean = distance.mean * percent;
  }
  return figures;
}

void Ratios::add(const Figures& ours, const Figures& theirs) {
  const auto log_ratio = [](double x, double y) { return std::log(std::max(x, 1e-9) / std::max(y, 1e-9)); };
  logarithms_.hausdorff += log_ratio(ours.hausdorff, theirs.hausdorff);
  logarithms_.mean += log_ratio(ours.mean, theirs.mean);
  logarithms_.seconds += log_ratio(ours.seconds, theirs.seconds);
  logarithms_.megabytes += log_ratio(ours.megabytes, theirs.megabytes);
  ++count_;
}

Figures Ratios::mean() const {
  const auto mean_of = [this](double sum) { return std::exp(sum / std::max(count_, 1)); };
  Figures means;
  means.hausdorff = mean_of(logarithms_.hausdorff);
  means.mean = mean_of(logarithms_.mean);
  means.seconds = mean_of(logarithms_.seconds);
  means.megabytes = mean_of(logarithms_.megabytes);
  return means;
}

}  // namespace selvage::bench
