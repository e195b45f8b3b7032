// SPDX-License-Identifier: MIT
#include "bench/simplify/peers.h"

#include <ctime>

#include <meshoptimizer.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "bench/simplify/heap_peak.h"
#include "bench/simplify/melax.h"
#include "common/mesh_io/openmesh_mesh.h"
#include "server/simplify/levels.h"
#include "server/simplify/simplify.h"

namespace selvage::bench {
namespace {

/// Runs `work` once and notes its CPU time and memory.
template <class Work>
Outcome measured(Work work) {
  Outcome outcome;
  forget_heap_peak();
  const std::size_t before = heap_in_use();
  const std::clock_t start = std::clock();
  outcome.soup = work();
  outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  outcome.working_bytes = heap_peak() - before;
  return outcome;
}

TriangleSoup ours(const BenchMesh& mesh, std::size_t target, const SimplifyOptions& options) {
  const LevelTarget level{.triangles = static_cast<std::uint32_t>(target)};
  const Simplification run = simplify({mesh.table, mesh.soup.positions}, {&level, 1}, options);
  const auto count = static_cast<std::uint32_t>(run.collapses.size());
  return {mesh.soup.positions,
          substituted_triangles(mesh.table,
                                representatives_after(run.collapses, count, mesh.table.vertex_count()))};
}

/// meshopt_simplify without an error limit.
Outcome meshopt(const BenchMesh& mesh, std::size_t target) {
  std::vector<unsigned int> indices, coarse(3 * mesh.soup.triangles.size());
  for (const Triangle& t : mesh.soup.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<float> points;
  for (const Vec3& p : mesh.soup.positions) points.insert(points.end(), {float(p.x), float(p.y), float(p.z)});
  std::size_t size = 0;
  Outcome outcome = measured([&] {
    size = meshopt_simplify(coarse.data(), indices.data(), indices.size(), points.data(), points.size() / 3,
                            3 * sizeof(float), 3 * target, 1e9f, 0, nullptr);
    return TriangleSoup{};
  });
  outcome.soup.positions = mesh.soup.positions;
  for (std::size_t i = 0; i < size; i += 3) {
    outcome.soup.triangles.push_back({coarse[i], coarse[i + 1], coarse[i + 2]});
  }
  return outcome;
}

/// Quadrics and the normal flipping test, as its manual combines them. Memory counts the mesh, which it works
/// in: ours is copied too.
Outcome openmesh(const BenchMesh& mesh, std::size_t target) {
  using Decimater = OpenMesh::Decimater::DecimaterT<OpenMeshTriMesh>;
  double seconds = 0;
  Outcome outcome = measured([&]() -> TriangleSoup {
    auto converted = to_openmesh(mesh.soup);
    if (!converted) return {};
    converted->request_face_normals();
    converted->update_face_normals();
    const std::clock_t start = std::clock();
    Decimater decimater(*converted);
    OpenMesh::Decimater::ModQuadricT<OpenMeshTriMesh>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<OpenMeshTriMesh>::Handle flipping;
    decimater.add(quadric);
    decimater.add(flipping);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, target);
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return from_openmesh(*converted);
  });
  outcome.seconds = seconds;
  return outcome;
}

}  // namespace

#ifdef SELVAGE_HAS_CGAL
Outcome cgal_reduce(const BenchMesh& mesh, std::size_t target);  // cgal_peer.cpp
#endif

std::vector<Simplifier> all_simplifiers() {
  const auto with_cost = [](CollapseCost cost, bool measures_deviation) {
    return [=](const BenchMesh& mesh, std::size_t target) {
      const SimplifyOptions options{.cost = cost, .measures_deviation = measures_deviation};
      return measured([&] { return ours(mesh, target, options); });
    };
  };
  std::vector<Simplifier> all = {{"md", with_cost(CollapseCost::PlaneDistance, true)},
                                 {"ea", with_cost(CollapseCost::EdgeArea, false)},
                                 {"qem", with_cost(CollapseCost::Quadric, false)},
                                 {"meshopt", meshopt},
                                 {"openmesh", openmesh},
                                 {"melax", [](const BenchMesh& mesh, std::size_t target) {
                                    return measured([&] { return melax_reduce(mesh.soup, target); });
                                  }}};
#ifdef SELVAGE_HAS_CGAL
  all.push_back({"cgal", cgal_reduce});
#endif
  return all;
}

}  // namespace selvage::bench
