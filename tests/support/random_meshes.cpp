// SPDX-License-Identifier: MIT
#include "tests/support/random_meshes.h"

#include <algorithm>
#include <random>

#include "tests/support/shapes.h"

namespace selvage {

RandomManifold split_fans(const TriangleSoup& soup) {
  RandomManifold mesh{build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size())),
                      {}};
  CornerTable& table = mesh.table;
  std::vector<VertexId> copy_of_corner(table.corner_count(), kNone);
  for (CornerId seed = 0; seed < table.corner_count(); ++seed) {
    if (copy_of_corner[seed] != kNone) continue;
    const auto copy = static_cast<VertexId>(mesh.positions.size());
    mesh.positions.push_back(soup.positions[table.vertex(seed)]);
    for (CornerId c = seed; c != kNone && copy_of_corner[c] == kNone; c = table.swing_ccw(c))
      copy_of_corner[c] = copy;
    for (CornerId c = table.swing_cw(seed); c != kNone && copy_of_corner[c] == kNone; c = table.swing_cw(c))
      copy_of_corner[c] = copy;
  }
  table.vertex_of_corner = copy_of_corner;
  table.set_corner_of_vertex(static_cast<std::uint32_t>(mesh.positions.size()));
  return mesh;
}

RandomManifold random_manifold(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  TriangleSoup soup;
  for (int component = 0, count = 1 + below(4); component < count; ++component) {
    TriangleSoup piece;
    switch (below(6)) {
      case 0:
        piece = shapes::torus(3 + below(8), 3 + below(8));
        break;
      case 1:
        piece = shapes::sphere(below(4));
        break;
      case 2:
        piece = shapes::grid_with_holes(4 + below(12), 4 + below(12), below(3));
        break;
      case 3:
        piece = shapes::open_cylinder(3 + below(6), 1 + below(6));
        break;
      case 4:
        piece = shapes::chain_of_tori(below(4));
        break;
      default:
        piece = shapes::tetrahedron();
        break;
    }
    shapes::append(soup, shapes::translated(piece, {10.0 * component, 0, 0}));
  }
  const int cut_percent = below(3) == 0 ? 0 : below(40);
  std::vector<Triangle> kept;
  for (const Triangle& t : soup.triangles) {
    if (below(100) >= cut_percent) kept.push_back({t});
  }
  if (kept.empty()) kept.push_back(soup.triangles[0]);
  for (Triangle& t : kept) std::rotate(t.begin(), t.begin() + below(3), t.end());
  std::shuffle(kept.begin(), kept.end(), random);
  soup.triangles = kept;
  return split_fans(soup);
}

}  // namespace selvage
