// SPDX-License-Identifier: MIT
#include "common/mesh/same_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "common/mesh/grid.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// The same mesh as another program might write it: vertices renumbered, triangles reordered and rotated.
TriangleSoup shuffled(const TriangleSoup& soup, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> new_index(soup.positions.size());
  std::iota(new_index.begin(), new_index.end(), 0u);
  std::shuffle(new_index.begin(), new_index.end(), random);
  TriangleSoup out;
  out.positions.resize(soup.positions.size());
  for (std::size_t v = 0; v < new_index.size(); ++v) out.positions[new_index[v]] = soup.positions[v];
  for (const Triangle& t : soup.triangles) {
    const unsigned turn = random() % 3;
    Triangle moved;
    for (unsigned k = 0; k < 3; ++k) moved[k] = new_index[t[(k + turn) % 3]];
    out.triangles.push_back(moved);
  }
  std::shuffle(out.triangles.begin(), out.triangles.end(), random);
  return out;
}

struct Quantised {
  TriangleSoup soup;
  double tolerance;
};

Quantised quantised(TriangleSoup soup, int bits) {
  const Grid grid = make_grid(soup.positions, bits);
  for (Vec3& p : soup.positions) p = grid.position(grid.quantise(p));
  return {std::move(soup), grid.step / 2};
}

TriangleSoup joined(TriangleSoup a, const TriangleSoup& b) {
  shapes::append(a, b);
  return a;
}

TriangleSoup scaled(TriangleSoup soup, double by) {
  for (Vec3& p : soup.positions) p = p * by;
  return soup;
}

/// `count` triangles that share no vertices and all lie at the same place.
TriangleSoup coincident_triangles(int count) {
  TriangleSoup soup;
  for (int i = 0; i < count; ++i) shapes::append(soup, shapes::triangle());
  return soup;
}

/// `count` triangles on one directed edge, all tips at the same place but for the last.
TriangleSoup book(int count) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}}, {}};
  for (int i = 0; i < count; ++i) {
    soup.positions.push_back({0.5, i + 1 == count ? 2.0 : 1.0, 0});
    soup.triangles.push_back({0, 1, static_cast<std::uint32_t>(i + 2)});
  }
  return soup;
}

/// Two spheres at one place, and two tori at another.
TriangleSoup coincident_components() {
  TriangleSoup soup = joined(shapes::sphere(2), shapes::sphere(2));
  return joined(joined(soup, shapes::torus(6, 9)), shapes::torus(6, 9));
}

/// Four spheres that touch in one vertex, two and two alike: one vertex with coincident fans.
TriangleSoup pinched_spheres() {
  TriangleSoup soup;
  for (int copy = 0; copy < 4; ++copy) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    shapes::append(soup, shapes::translated(shapes::sphere(1 + copy % 2), {-1, 0, 0}));
    for (Triangle& t : soup.triangles)
      for (std::uint32_t& v : t)
        if (v == base) v = 0;
  }
  return soup;
}

struct Shape {
  const char* name;
  TriangleSoup soup;
};

std::vector<Shape> all_shapes() {
  TriangleSoup doubled = shapes::torus(7, 11);
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin() + 5,
                           doubled.triangles.begin() + 20);
  TriangleSoup collapsed = shapes::grid(12, 12);  // zero-area triangles: a patch of it in one point
  for (std::size_t v = 40; v < 60; ++v) collapsed.positions[v] = collapsed.positions[40];
  TriangleSoup all_in_a_point = shapes::torus(5, 6);
  for (Vec3& p : all_in_a_point.positions) p = {1, 2, 3};
  TriangleSoup turned = shapes::sphere(3);
  for (std::size_t t = 0; t < turned.triangles.size(); t += 3)
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  return {{"empty", {}},
          {"triangle", shapes::triangle()},
          {"tetrahedron", shapes::tetrahedron()},
          {"grid", shapes::grid(40, 30)},
          {"holes", shapes::grid_with_holes(20, 20, 5)},
          {"torus", shapes::torus(12, 31)},
          {"sphere", shapes::sphere(4)},
          {"cylinder", shapes::open_cylinder(9, 4)},
          {"mobius", shapes::mobius_strip(21)},
          {"genus 4", shapes::chain_of_tori(3)},
          {"coincident triangles", coincident_triangles(50)},
          {"book", book(6)},
          {"coincident components", coincident_components()},
          {"pinched spheres", pinched_spheres()},
          {"duplicate triangles", doubled},
          {"collapsed patch", collapsed},
          {"all in a point", all_in_a_point},
          {"turned triangles", turned}};
}

TEST(SameMesh, HoldsForAMeshAndItself) {
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name);
    const MeshComparison result = compare_meshes(shape.soup, shape.soup, 0);
    EXPECT_TRUE(result.same) << result.difference;
    EXPECT_EQ(result.largest_difference, 0);
    EXPECT_EQ(result.difference, "");
  }
}

TEST(SameMesh, HoldsUnderRenumberingReorderingAndRotation) {
  for (const Shape& shape : all_shapes()) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(shape.name);
      const MeshComparison result = compare_meshes(shape.soup, shuffled(shape.soup, seed), 0);
      EXPECT_TRUE(result.same) << result.difference;
    }
  }
}

TEST(SameMesh, HoldsAfterQuantisation) {
  for (const Shape& shape : all_shapes()) {
    for (int bits = kMinGridBits; bits <= 14; ++bits) {
      SCOPED_TRACE(shape.name + std::string(" at bits ") + std::to_string(bits));
      const Quantised q = quantised(shuffled(shape.soup, 7), bits);
      const MeshComparison result = compare_meshes(shape.soup, q.soup, q.tolerance);
      EXPECT_TRUE(result.same) << result.difference;
      EXPECT_LE(result.largest_difference, q.tolerance * 1.000001);
    }
  }
}

TEST(SameMesh, HoldsWhereManyVerticesFallOnOneGridPoint) {
  const TriangleSoup fine = shapes::sphere(7);  // 65k vertices
  for (int bits : {3, 5}) {
    const Quantised q = quantised(shuffled(fine, 3), bits);
    const MeshComparison result = compare_meshes(fine, q.soup, q.tolerance);
    EXPECT_TRUE(result.same) << bits << ": " << result.difference;
  }
}

TEST(SameMesh, HoldsForManyComponentsWithinTheTolerance) {
  TriangleSoup chain;  // each could be its neighbour, but only one assignment serves all
  for (int i = 0; i < 200; ++i)
    shapes::append(chain, shapes::translated(shapes::triangle(), {0.6 * i, 0, 0}));
  const MeshComparison result =
      compare_meshes(chain, shapes::translated(shuffled(chain, 1), {0.9, 0, 0}), 0.9);
  EXPECT_TRUE(result.same) << result.difference;
}

TEST(SameMesh, HoldsWhateverTheTolerance) {
  const TriangleSoup soup = joined(shapes::sphere(3), shapes::grid(9, 9));
  for (double tolerance : {0.0, 1e-300, 1e6, 1e308, std::numeric_limits<double>::infinity()}) {
    const MeshComparison result = compare_meshes(soup, shuffled(soup, 1), tolerance);
    EXPECT_TRUE(result.same) << tolerance << ": " << result.difference;
  }
}

TEST(SameMesh, IgnoresUnusedVerticesAndTrianglesWithARepeatedIndex) {
  const TriangleSoup clean = shapes::sphere(2);
  TriangleSoup littered = clean;
  littered.positions.push_back({9, 9, 9});
  littered.triangles.push_back({4, 4, 5});
  const MeshComparison result = compare_meshes(littered, clean, 0);
  EXPECT_TRUE(result.same) << result.difference;
  EXPECT_EQ(result.repeated_index_a, 1u);
  EXPECT_EQ(result.repeated_index_b, 0u);
}

TEST(SameMesh, ReportsTheLargestDifferencePerAxis) {
  const TriangleSoup soup = shapes::sphere(2);
  TriangleSoup moved = soup;
  moved.positions[5] += {0.01, -0.03, 0.02};
  const MeshComparison result = compare_meshes(soup, moved, 0.05);
  EXPECT_TRUE(result.same) << result.difference;
  EXPECT_NEAR(result.largest_difference, 0.03, 1e-12);
}

TEST(SameMesh, TakesTheToleranceInclusively) {
  const TriangleSoup soup = scaled(shapes::sphere(2), 1000);
  const TriangleSoup moved = shapes::translated(soup, {0.1, 0.1, 0.1});
  EXPECT_TRUE(compare_meshes(soup, moved, 0.1).same);
  EXPECT_FALSE(compare_meshes(soup, moved, 0.0999).same);
}

/// The claim of every test below: this pair differs, that is known for sure, and a sentence says where.
void expect_different(const TriangleSoup& a, const TriangleSoup& b, double tolerance = 0) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const MeshComparison result = compare_meshes(a, shuffled(b, seed), tolerance);
    EXPECT_FALSE(result.same);
    EXPECT_FALSE(result.undecided);
    EXPECT_NE(result.difference, "");
  }
}

TEST(SameMesh, SeesAVertexBeyondTheTolerance) {
  TriangleSoup moved = shapes::sphere(3);
  moved.positions[17].y += 0.011;
  expect_different(shapes::sphere(3), moved, 0.01);
}

TEST(SameMesh, ComparesExactlyAtToleranceZero) {
  TriangleSoup moved = shapes::sphere(3);
  moved.positions[17].y = std::nextafter(moved.positions[17].y, 2);
  expect_different(shapes::sphere(3), moved);
}

TEST(SameMesh, SeesOneFlippedTriangle) {
  for (const TriangleSoup& soup :
       {shapes::triangle(), shapes::sphere(3), shapes::mobius_strip(9), shapes::torus(6, 9)}) {
    TriangleSoup flipped = soup;
    std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
    expect_different(soup, flipped);
  }
}

TEST(SameMesh, SeesAMirroredMesh) {
  TriangleSoup turned = shapes::sphere(3);
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  expect_different(shapes::sphere(3), turned);
}

TEST(SameMesh, SeesAMissingTriangle) {
  TriangleSoup less = shapes::torus(6, 9);
  less.triangles.pop_back();
  expect_different(shapes::torus(6, 9), less);
  expect_different(less, shapes::torus(6, 9));
}

TEST(SameMesh, SeesWhichTriangleIsDoubled) {
  TriangleSoup first = shapes::torus(6, 9), second = first;
  first.triangles.push_back(first.triangles[0]);
  second.triangles.push_back(second.triangles[2]);
  expect_different(first, second);
}

TEST(SameMesh, SeesACrackBehindEqualPositions) {
  const TriangleSoup whole = shapes::grid(8, 8);
  TriangleSoup cracked = whole;
  const std::uint32_t v = cracked.triangles[30][0];
  cracked.triangles[30][0] = static_cast<std::uint32_t>(cracked.positions.size());
  cracked.positions.push_back(Vec3(cracked.positions[v]));
  expect_different(whole, cracked);
}

TEST(SameMesh, SeesACrackThatMovedElsewhere) {
  TriangleSoup here = shapes::grid(8, 8), there = here;
  const auto cut = [](TriangleSoup& soup, std::size_t triangle) {
    const std::uint32_t v = soup.triangles[triangle][0];
    soup.triangles[triangle][0] = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.push_back(Vec3(soup.positions[v]));
  };
  cut(here, 34);
  cut(there, 50);
  expect_different(here, there);
}

/// Two grids of different cells in one place: every position is taken twice.
TriangleSoup two_coincident_grids() {
  TriangleSoup soup = shapes::grid(8, 8);
  TriangleSoup other = soup;
  for (std::size_t t = 0; t + 1 < other.triangles.size(); t += 2) {  // the other diagonal in each cell
    const auto [a, b, c] = other.triangles[t];
    const std::uint32_t d = other.triangles[t + 1][2];
    other.triangles[t] = {a, b, d};
    other.triangles[t + 1] = {b, c, d};
  }
  return joined(soup, other);
}

TEST(SameMesh, SeesVerticesSwappedBetweenCoincidentSheets) {
  const TriangleSoup soup = two_coincident_grids();
  TriangleSoup crossed = soup;
  const std::uint32_t sheet = 81;
  const auto swap_ends = [&](std::uint32_t v) {  // v moves to the other sheet in some of its triangles only
    for (Triangle& t : crossed.triangles)
      for (std::uint32_t& w : t)
        if (w == v)
          w = v + sheet;
        else if (w == v + sheet)
          w = v;
  };
  swap_ends(40);  // only a renumbering: both sheets' triangles exchange the vertex
  EXPECT_TRUE(compare_meshes(soup, crossed, 0).same);
  Triangle& t = crossed.triangles[60];
  t[1] = t[1] < sheet ? t[1] + sheet : t[1] - sheet;
  expect_different(soup, crossed);
}

TEST(SameMesh, SeesPiecesThatChangedPlaces) {
  // A square and a strip of equal counts, near each other: as position sets with any tolerance they agree.
  const TriangleSoup left = shapes::grid(3, 3), right = shapes::translated(shapes::torus(5, 5), {0, 0, 9});
  const TriangleSoup left_moved = shapes::translated(shapes::grid(3, 3), {0, 0, 9});
  expect_different(joined(left, right), joined(left_moved, shapes::torus(5, 5)), 0.5);
}

TEST(SameMesh, SeesAMissingTwistWhateverThePositions) {
  TriangleSoup strip = shapes::mobius_strip(12), band = strip;
  band.triangles[22] = {22, 23, 1};  // the last piece joins the first the right way round
  band.triangles[23] = {22, 1, 0};
  for (TriangleSoup* soup : {&strip, &band})
    for (Vec3& p : soup->positions) p = {};
  expect_different(strip, band);
}

TEST(SameMesh, TellsConnectivityApartThatColoursCannot) {
  // Closed tori of 8x8 and 4x16 squares: every vertex looks alike from inside.
  TriangleSoup square = shapes::torus(8, 8), oblong = shapes::torus(4, 16);
  for (TriangleSoup* soup : {&square, &oblong})
    for (Vec3& p : soup->positions) p = {};
  expect_different(square, oblong);
}

TEST(SameMesh, GivesUpAPlaceThatAnotherComponentNeedsMore) {
  // Component i fits the places i and i + 1 and is nearer to i + 1; only the last has no choice. Each in turn
  // has to leave the place that it took first.
  TriangleSoup components, places;
  for (int i = 0; i < 30; ++i) {
    shapes::append(components, shapes::translated(shapes::triangle(), {0.6 + i, 0, 0}));
    shapes::append(places, shapes::translated(shapes::triangle(), {1.0 * i, 0, 0}));
  }
  const MeshComparison result = compare_meshes(components, places, 0.61);
  EXPECT_TRUE(result.same) << result.difference;
  EXPECT_NEAR(result.largest_difference, 0.6, 1e-12);
}

TEST(SameMesh, SeesOnePlaceTooFew) {
  TriangleSoup components, places;  // three components fight over two places; the third place is out of reach
  for (double x : {0.0, 0.1, 0.2})
    shapes::append(components, shapes::translated(shapes::triangle(), {x, 0, 0}));
  for (double x : {0.0, 0.1, 9.0}) shapes::append(places, shapes::translated(shapes::triangle(), {x, 0, 0}));
  const MeshComparison result = compare_meshes(components, places, 0.5);
  EXPECT_FALSE(result.same);
}

/// A binary tree of triangles that meet only in vertices, all in one point. `leaves` says which of the
/// 2^depth ends get a triangle more.
TriangleSoup triangle_tree(int depth, const std::vector<bool>& leaves) {
  TriangleSoup soup{{{}}, {}};
  const auto hang_triangle = [&](std::uint32_t from) {
    const auto tip = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.resize(tip + 2);
    soup.triangles.push_back({from, tip, tip + 1});
    return tip;
  };
  std::vector<std::uint32_t> ends = {0};
  for (int level = 0; level < depth; ++level) {
    std::vector<std::uint32_t> further;
    for (std::uint32_t end : ends) further.insert(further.end(), {hang_triangle(end), hang_triangle(end)});
    ends = further;
  }
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (leaves[i]) hang_triangle(ends[i]);
  return soup;
}

TEST(SameMesh, StaysBoundedWhereSymmetryIsHopeless) {
  std::vector<bool> in_halves(1024), alternating(1024);
  for (std::size_t i = 0; i < 1024; ++i) in_halves[i] = i < 512, alternating[i] = i / 32 % 2 == 0;
  const MeshComparison result =
      compare_meshes(triangle_tree(10, in_halves), triangle_tree(10, alternating), 0);
  EXPECT_FALSE(result.same);
  EXPECT_TRUE(result.undecided) << result.difference;
}

}  // namespace
}  // namespace selvage
