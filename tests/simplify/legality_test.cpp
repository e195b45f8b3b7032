// SPDX-License-Identifier: MIT
#include "server/simplify/legality.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace selvage {
namespace {

struct Fixture {
  explicit Fixture(const TriangleSoup& soup)
      : mesh(build_corner_table(soup.triangles, std::uint32_t(soup.positions.size()))),
        positions(soup.positions),
        stamps(std::uint32_t(soup.positions.size())) {}

  std::uint32_t gather(VertexId u, VertexId v) {
    star.gather(mesh, positions, u);
    return star.place_of(v);
  }
  bool keeps_links(VertexId u, VertexId v) { return keeps_manifold(mesh, star, gather(u, v), stamps); }

  CornerTable mesh;
  std::vector<Vec3> positions;
  Stamps stamps;
  Star star;
};

/// Around vertex 0 a flat ring of 1..n at the given points, counter-clockwise.
Fixture fan(const std::vector<Vec3>& ring) {
  TriangleSoup soup{{{0, 0, 0}}, {}};
  soup.positions.insert(soup.positions.end(), ring.begin(), ring.end());
  const auto n = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < n; ++i) soup.triangles.push_back({0, i + 1, (i + 1) % n + 1});
  return Fixture(soup);
}

TEST(Legality, RefusesToFlattenATetrahedron) {
  Fixture f(shapes::tetrahedron());
  EXPECT_FALSE(f.keeps_links(0, 1));
}

TEST(Legality, RefusesToCloseARing) {
  // Three vertices around a tube have a third common neighbour each.
  Fixture f(shapes::torus(3, 12));
  EXPECT_FALSE(f.keeps_links(0, 1));
  EXPECT_TRUE(f.keeps_links(0, 3));  // along the tube
}

TEST(Legality, RefusesToTakeAVertexLastTriangle) {
  // 3 is an ear at the edge 1-2, which is inside; without the triangle 1 2 3 it would be left in the air.
  Fixture f({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}}});
  EXPECT_FALSE(f.keeps_links(1, 2));
  EXPECT_TRUE(f.keeps_links(1, 3));   // along the border
  EXPECT_FALSE(f.keeps_links(3, 1));  // 3 has nothing to hand on
}

TEST(Legality, SeesATriangleTurnOver) {
  // The notch at 3 makes the triangle (0, 3, 4) turn when 0 goes to 2.
  Fixture f = fan({{2, 0, 0}, {1, 2, 0}, {0, 0.5, 0}, {-2, 2, 0}, {-1, -2, 0}});
  const std::uint32_t to_beside = f.gather(0, 2), to_notch = f.gather(0, 3);
  EXPECT_FALSE(keeps_normals(f.star, to_beside));
  EXPECT_FALSE(keeps_convexity(f.star, to_beside));
  EXPECT_TRUE(keeps_normals(f.star, to_notch));
  EXPECT_TRUE(keeps_convexity(f.star, to_notch));
}

TEST(Legality, SeesATriangleBecomeALine) {
  // Fig. 3.9: 1 to 3 lie on one line.
  Fixture f = fan({{1, -1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}});
  const std::uint32_t place = f.gather(0, 1);
  EXPECT_FALSE(keeps_normals(f.star, place));
  EXPECT_FALSE(keeps_convexity(f.star, place));
}

}  // namespace
}  // namespace selvage
