// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "client/decode/region_decoder.h"
#include "common/mesh/check_corner_table.h"
#include "server/encode/region_encoder.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr int kBits = 12;

RegionSource source_of(const RandomManifold& mesh, std::uint32_t seed = 0) {
  const Grid grid = make_grid(mesh.positions, kBits);
  RegionSource source{mesh.table, {}, {}, {}};
  for (const Vec3& p : mesh.positions) source.positions.push_back(grid.quantise(p));
  std::mt19937 random(seed);
  if (seed % 3 == 1) {
    for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t)
      source.is_turned.push_back(random() % 4 == 0);
  }
  if (seed % 2 == 1) {
    for (VertexId v = 0; v < mesh.table.vertex_count(); ++v)
      source.weld_groups.push_back(random() % 5 == 0 ? random() % 1000 : kNone);
  }
  return source;
}

DecodeLimits limits_of(const RegionSource& source) {
  DecodeLimits limits{source.table.vertex_count(), source.table.triangle_count(), source.positions[0],
                      source.positions[0]};
  for (const GridPoint& p : source.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      limits.box_min[axis] = std::min(limits.box_min[axis], p[axis]);
      limits.box_max[axis] = std::max(limits.box_max[axis], p[axis]);
    }
  }
  if (!source.exact.empty()) limits.exact = source.grid;
  return limits;
}

/// A triangle as source vertices and whether it is turned, starting at its lowest vertex.
using Fact = std::pair<Triangle, bool>;

std::vector<Fact> facts(const std::vector<Triangle>& triangles, const std::vector<bool>& is_turned,
                        const std::vector<VertexId>& source_of_vertex) {
  std::vector<Fact> all;
  for (TriangleId t = 0; t < triangles.size(); ++t) {
    Triangle triangle = triangles[t];
    for (VertexId& v : triangle) v = source_of_vertex[v];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    all.emplace_back(triangle, !is_turned.empty() && is_turned[t]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Each as source vertices, starting at its lowest one.
std::vector<std::vector<VertexId>> loops_of(const BoundaryLoops& loops,
                                            const std::vector<VertexId>& source_of_vertex) {
  std::vector<std::vector<VertexId>> all;
  auto vertex = loops.vertices.begin();
  for (const std::uint32_t length : loops.lengths) {
    std::vector<VertexId>& loop = all.emplace_back();
    for (std::uint32_t i = 0; i < length; ++i) loop.push_back(source_of_vertex[*vertex++]);
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_round_trip(const RegionSource& source) {
  const EncodedRegion encoded = encode_region(source);
  const auto decoded = decode_region(encoded.bytes, limits_of(source));
  ASSERT_TRUE(decoded) << decoded.error().message;
  const auto sound = check_region_mesh(*decoded);
  ASSERT_TRUE(sound) << sound.error().message;

  std::vector<VertexId> identity(source.table.vertex_count());
  for (VertexId v = 0; v < identity.size(); ++v) identity[v] = v;
  std::vector<Triangle> triangles;
  for (TriangleId t = 0; t < source.table.triangle_count(); ++t)
    triangles.push_back(source.table.triangle(t));
  EXPECT_EQ(facts(decoded->triangles, decoded->is_turned, encoded.source_of_vertex),
            facts(triangles, source.is_turned, identity));
  if (!triangles.empty()) {
    EXPECT_EQ(loops_of(decoded->loops, encoded.source_of_vertex),
              loops_of(find_boundary_loops(source.table), identity));
  }
  for (VertexId v = 0; v < identity.size(); ++v)
    EXPECT_EQ(decoded->positions[v], source.positions[encoded.source_of_vertex[v]]);
  EXPECT_EQ(decoded->loops.vertices, encoded.loops.vertices);
  EXPECT_EQ(decoded->loops.lengths, encoded.loops.lengths);

  std::size_t anchors = 0;
  for (std::uint32_t group : source.weld_groups) anchors += group != kNone;
  EXPECT_EQ(decoded->anchors.size(), anchors);
  for (const Anchor& anchor : decoded->anchors)
    EXPECT_EQ(anchor.group, source.weld_groups[encoded.source_of_vertex[anchor.vertex]]);
}

TEST(RegionCodec, RoundTripsHandMadeShapes) {
  TriangleSoup many = shapes::grid_with_holes(9, 9, 3);
  shapes::append(many, shapes::torus(4, 5));
  shapes::append(many, shapes::triangle());
  shapes::append(many, shapes::tetrahedron());
  for (const TriangleSoup& soup :
       {shapes::triangle(), shapes::tetrahedron(), shapes::grid(1, 1), shapes::grid(7, 5),
        shapes::grid_with_holes(10, 10, 3), shapes::torus(3, 3), shapes::torus(8, 5), shapes::sphere(3),
        shapes::open_cylinder(6, 4), shapes::chain_of_tori(0), shapes::chain_of_tori(5), many}) {
    SCOPED_TRACE(soup.triangles.size());
    expect_round_trip(source_of(split_fans(soup)));
  }
}

TEST(RegionCodec, RoundTripsRandomManifolds) {
  for (std::uint32_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    expect_round_trip(source_of(random_manifold(seed), seed));
    if (HasFatalFailure()) return;
  }
}

TEST(RegionCodec, RoundTripsTwoTrianglesOnTheSameThreeVertices) {
  RandomManifold pillow{CornerTable{{0, 1, 2, 0, 2, 1}, {3, 5, 4, 0, 2, 1}, {}},
                        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  pillow.table.set_corner_of_vertex(3);
  ASSERT_TRUE(check_corner_table(pillow.table));
  expect_round_trip(source_of(pillow));
}

/// An octahedron with one edge twice. Which triangles meet across it their vertices do not say.
TEST(RegionCodec, RoundTripsAnEdgeThatIsThereTwice) {
  RandomManifold mesh{
      CornerTable{{0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 0, 5, 0, 2, 5, 0, 4, 3, 1, 3, 4, 1, 5, 2}, {}, {}}, {}};
  const std::vector<VertexId>& vertices = mesh.table.vertex_of_corner;
  mesh.table.opposite.assign(vertices.size(), kNone);
  for (CornerId c = 0; c < vertices.size(); ++c) {
    for (CornerId d = 0; d < vertices.size(); ++d) {
      const bool is_across = vertices[next(c)] == vertices[prev(d)] && vertices[prev(c)] == vertices[next(d)];
      const bool is_twice = vertices[next(c)] + vertices[prev(c)] == 1;
      if (is_across && (!is_twice || vertices[c] / 4 == vertices[d] / 4)) mesh.table.opposite[c] = d;
    }
  }
  mesh.table.set_corner_of_vertex(6);
  ASSERT_TRUE(check_corner_table(mesh.table));
  for (int v = 0; v < 6; ++v) mesh.positions.push_back({double(v % 2), double(v % 3), double(v)});
  expect_round_trip(source_of(mesh));
}

TEST(RegionCodec, RoundTripsLooseVertices) {
  RegionSource source;
  source.positions = {{5, 6, 7}, {4095, 0, 9}, {5, 6, 7}};
  source.table.set_corner_of_vertex(3);
  source.weld_groups = {kNone, 17, kNone};
  expect_round_trip(source);
}

/// Floats as awkward as they come, most of them in their grid point's cell.
RegionSource exact_source(std::uint32_t seed) {
  const RandomManifold mesh = random_manifold(seed);
  RegionSource source = source_of(mesh, seed);
  source.grid = make_grid(mesh.positions, kBits);
  std::mt19937 random(seed);
  constexpr float kOdd[] = {0.0f, -0.0f, 1e-45f, -1e-40f, 3.4028235e38f, -3.4028235e38f, 1.0f};
  for (const Vec3& p : mesh.positions) {
    ExactPosition exact{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    if (random() % 4 == 0) exact[random() % 3] = kOdd[random() % std::size(kOdd)];
    source.exact.push_back(exact);
  }
  return source;
}

TEST(RegionCodec, RestoresFloatsBitForBit) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const RegionSource source = exact_source(seed);
    const EncodedRegion encoded = encode_region(source);
    const auto decoded = decode_region(encoded.bytes, limits_of(source));
    ASSERT_TRUE(decoded) << decoded.error().message;
    ASSERT_EQ(decoded->exact.size(), source.exact.size());
    for (VertexId v = 0; v < decoded->exact.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(decoded->exact[v][axis]),
                  std::bit_cast<std::uint32_t>(source.exact[encoded.source_of_vertex[v]][axis]));
      }
    }
  }
}

// Most meshes in text files have such coordinates.
TEST(RegionCodec, TakesFewBitsForFloatsThatAreShortDecimals) {
  RegionSource source = source_of(split_fans(shapes::sphere(4)));
  source.grid = Grid{.origin = {-50, 0.25, 1000}, .step = 0.01, .bits = kBits};
  std::mt19937 random(1);
  for (const GridPoint& p : source.positions) {
    ExactPosition exact{};
    for (int axis = 0; axis < 3; ++axis) {
      const double within = (static_cast<int>(random() % 9) - 4) * 0.001;  // one decimal of nine in the cell
      const double value = source.grid.origin[axis] + p[axis] * source.grid.step + within;
      exact[static_cast<std::size_t>(axis)] = static_cast<float>(std::round(value * 1000) / 1000);
    }
    source.exact.push_back(exact);
  }
  RegionSource without = source;
  without.exact.clear();
  const EncodedRegion encoded = encode_region(source);
  ASSERT_TRUE(decode_region(encoded.bytes, limits_of(source)));
  const double bits = 8.0 * static_cast<double>(encoded.bytes.size() - encode_region(without).bytes.size()) /
                      static_cast<double>(3 * source.exact.size());
  EXPECT_LT(bits, std::log2(11) + 0.3);  // eleven with both ends
}

TEST(Decimals, RankAsTheirValuesDo) {
  for (const Decimals decimals : {Decimals{1, 0}, Decimals{6, 6}, Decimals{9, 15}, Decimals{3, 2}}) {
    for (std::int64_t rank = -5000; rank < 5000; ++rank)
      EXPECT_LE(decimals.value(rank), decimals.value(rank + 1)) << rank;
  }
}

TEST(Decimals, ComeBackFromTheirFloats) {
  const Decimals six{6, 6};
  for (const float value : {0.0f, 0.1f, 1.25f, -3.14159f, 123456e10f, 0.000001f, 99999.9f, 100000.0f, -1e20f})
    EXPECT_EQ(six.value(six.rank(double{value})), value);
  EXPECT_NE(six.value(six.rank(0.1234567)), 0.1234567f);
  EXPECT_TRUE(std::isfinite(six.value(six.rank(3.4028234e38))));
}

TEST(RegionCodec, RefusesExactPositionsThatTheDirectoryDoesNotPromise) {
  const RegionSource source = exact_source(3);
  DecodeLimits limits = limits_of(source);
  limits.exact.reset();
  EXPECT_FALSE(decode_region(encode_region(source).bytes, limits));
}

TEST(RegionCodec, IsAPureFunctionOfItsInput) {
  const RegionSource source = source_of(random_manifold(42), 43);
  EXPECT_EQ(encode_region(source).bytes, encode_region(source).bytes);
}

TEST(RegionCodec, RefusesEveryTruncationAndExtraBytes) {
  const RegionSource source = source_of(random_manifold(7), 7);
  const Bytes bytes = encode_region(source).bytes;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes truncated(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(decode_region(truncated, limits_of(source))) << length;
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_region(longer, limits_of(source)));
}

TEST(RegionCodec, SurvivesEveryFlippedBit) {
  for (std::uint32_t seed : {1u, 7u, 11u}) {
    const RegionSource source = source_of(random_manifold(seed), seed);
    const Bytes bytes = encode_region(source).bytes;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      Bytes damaged = bytes;
      damaged[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
      const auto decoded = decode_region(damaged, limits_of(source));
      if (!decoded) continue;
      // Hashes catch damage; the decoder only owes a sound mesh of the promised size.
      EXPECT_TRUE(check_region_mesh(*decoded));
      EXPECT_EQ(decoded->positions.size(), source.positions.size());
    }
  }
}

TEST(RegionCodec, RefusesMoreThanTheDirectoryPromises) {
  const RegionSource source = source_of(random_manifold(5));
  const Bytes bytes = encode_region(source).bytes;
  DecodeLimits less = limits_of(source);
  --less.triangles;
  EXPECT_EQ(decode_region(bytes, less).error().code, ErrorCode::BadStream);
}

}  // namespace
}  // namespace selvage
