// SPDX-License-Identifier: MIT
//
// CGAL's edge collapse with Garland and Heckbert's cost and optimal placement [CGAL manual, Triangulated
// surface mesh simplification].
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <ctime>

#include "bench/simplify/heap_peak.h"
#include "bench/simplify/peers.h"

namespace selvage::bench {

Outcome cgal_reduce(const BenchMesh& mesh, std::size_t target) {
  namespace Simplify = CGAL::Surface_mesh_simplification;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Policies = Simplify::GarlandHeckbert_plane_policies<Mesh, Kernel>;
  using Placement = Simplify::Bounded_normal_change_placement<Policies::Get_placement>;
  Mesh surface;
  for (const Vec3& p : mesh.soup.positions) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.soup.triangles)
    surface.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));

  Outcome outcome;
  forget_heap_peak();
  const std::size_t before = heap_in_use();
  const std::clock_t start = std::clock();
  const Policies policies(surface);
  const Placement placement(policies.get_placement());
  Simplify::edge_collapse(surface, Simplify::Count_stop_predicate<Mesh>(3 * target / 2),
                          CGAL::parameters::get_cost(policies.get_cost()).get_placement(placement));
  outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  outcome.working_bytes = heap_peak() - before;

  surface.collect_garbage();
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    outcome.soup.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces()) {
    Triangle triangle{};
    std::size_t k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) triangle[k++] = v;
    outcome.soup.triangles.push_back(triangle);
  }
  return outcome;
}

}  // namespace selvage::bench
