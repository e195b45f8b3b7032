// SPDX-License-Identifier: MIT
//
// Does segmentation grow linearly, what memory does it take, and what do two cores bring?
//
//   growth_bench [--triangles 8700000]
//
// A generated watering can of about 34,000 triangles is subdivided (each triangle into four, at the middles
// of its edges) until there are so many. Every size runs in a process of its own, so that peak memory is its
// own: the process with the mesh alone is subtracted. CPU times of single runs in Morton order, streaming
// sizes. The last column is what a second core brings in the height field (critical_path.h).
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <unordered_map>

#include "bench/support/critical_path.h"
#include "common/samples/waterneck.h"
#include "server/ingest/repair.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/components.h"
#include "server/segment/height_field.h"
#include "server/segment/segment.h"
#include "server/segment/vertex_measures.h"

namespace selvage::bench {
namespace {

TriangleSoup subdivided(const TriangleSoup& soup) {
  TriangleSoup fine{soup.positions, {}};
  fine.triangles.reserve(4 * soup.triangles.size());
  std::unordered_map<std::uint64_t, VertexId> middle_of_edge;
  middle_of_edge.reserve(2 * soup.triangles.size());
  const auto middle = [&](VertexId a, VertexId b) {
    const auto key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [it, is_new] = middle_of_edge.try_emplace(key, static_cast<VertexId>(fine.positions.size()));
    if (is_new) fine.positions.push_back((soup.positions[a] + soup.positions[b]) * 0.5);
    return it->second;
  };
  for (const auto& [a, b, c] : soup.triangles) {
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(t);
  }
  return fine;
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

RepairedMesh mesh_of_level(int level) {
  TriangleSoup soup = make_waterneck(34000);
  for (int i = 0; i < level; ++i) soup = subdivided(soup);
  return spatially_ordered(std::move(*repair(soup)));
}

/// The mesh's own arrays, which any user of it holds.
double mesh_bytes(const RepairedMesh& mesh) {
  return static_cast<double>(mesh.table.corner_count()) * 8 + static_cast<double>(mesh.positions.size()) * 28;
}

void measure(int level) {
  // The peak of making the mesh hides that of segmentation, so it is made in a process before and passed by
  // pipe.
  int ends[2];
  if (pipe(ends) != 0) return;
  const pid_t maker = fork();
  if (maker == 0) {
    const RepairedMesh mesh = mesh_of_level(level);
    FILE* out = fdopen(ends[1], "wb");
    const std::uint32_t sizes[2] = {mesh.table.corner_count(), mesh.table.vertex_count()};
    std::fwrite(sizes, sizeof sizes, 1, out);
    std::fwrite(mesh.table.vertex_of_corner.data(), 4, sizes[0], out);
    std::fwrite(mesh.table.opposite.data(), 4, sizes[0], out);
    std::fwrite(mesh.positions.data(), sizeof(Vec3), sizes[1], out);
    std::fclose(out);
    std::_Exit(0);
  }
  close(ends[1]);
  FILE* in = fdopen(ends[0], "rb");
  std::uint32_t sizes[2] = {0, 0};
  RepairedMesh mesh;
  bool is_read = std::fread(sizes, sizeof sizes, 1, in) == 1;
  mesh.table.vertex_of_corner.resize(sizes[0]);
  mesh.table.opposite.resize(sizes[0]);
  mesh.positions.resize(sizes[1]);
  is_read = is_read && std::fread(mesh.table.vertex_of_corner.data(), 4, sizes[0], in) == sizes[0] &&
            std::fread(mesh.table.opposite.data(), 4, sizes[0], in) == sizes[0] &&
            std::fread(mesh.positions.data(), sizeof(Vec3), sizes[1], in) == sizes[1];
  std::fclose(in);
  waitpid(maker, nullptr, 0);
  if (!is_read) std::exit(1);
  mesh.table.set_corner_of_vertex(sizes[1]);

  const SegmentOptions options = with_streaming_sizes({}, mesh.table.triangle_count());
  const double before = peak_bytes();
  const double begin = thread_cpu_ms();
  const Segmentation result = segment(mesh.table, mesh.positions, options, serial_for());
  const double segment_ms = thread_cpu_ms() - begin;
  const double own = peak_bytes() - before, triangles = mesh.table.triangle_count();

  const Neighbours neighbours(mesh.table);
  const Components components = find_components(mesh.table);
  const auto shapes = measure_components(mesh.table, mesh.positions, components);
  const VertexMeasures measures = measure_vertices(mesh.table, mesh.positions);
  const auto height = [&](const ParallelFor& parallel) {
    measure_height(mesh.table, neighbours, mesh.positions, components, shapes, measures,
                   xmrg_options(options).height, parallel);
  };
  double one_core_ms = 1e30, two_cores_ms = 1e30;
  CriticalPath two_cores;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double start = thread_cpu_ms();
    height(serial_for());
    one_core_ms = std::min(one_core_ms, thread_cpu_ms() - start);
    two_cores_ms = std::min(two_cores_ms, two_cores.measure([&] { height(two_cores.parallel_for()); }));
  }
  std::vector<Triangle> list;
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t) list.push_back(mesh.table.triangle(t));
  const double adjacency_start = thread_cpu_ms();
  build_corner_table(list, sizes[1]);
  const double adjacency_ms = thread_cpu_ms() - adjacency_start;
  std::printf("%10.0f %8u %10.0f %12.1f %12.1f %10.1f %10.1f %12.2f\n", triangles, result.region_count,
              segment_ms, 1e5 * segment_ms / triangles, segment_ms / adjacency_ms, own / triangles,
              (own + mesh_bytes(mesh)) / triangles, one_core_ms / two_cores_ms);
}

int run(int argc, char** argv) {
  double most = 8.7e6;
  if (argc == 3 && std::string(argv[1]) == "--triangles") {
    most = std::stod(argv[2]);
  } else if (argc != 1) {
    return std::fprintf(stderr, "usage: growth_bench [--triangles N]\n"), 2;
  }
  std::printf("%10s %8s %10s %12s %12s %10s %10s %12s\n", "triangles", "regions", "CPU ms", "ms per 100k",
              "x adjacency", "B/tri own", "with mesh", "height 1:2");
  double triangles = 34000;
  for (int level = 0; triangles <= 1.1 * most; ++level, triangles *= 4) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      measure(level);
      std::fflush(stdout);
      std::_Exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (status != 0) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) { return selvage::bench::run(argc, argv); }
