// SPDX-License-Identifier: MIT
//
// Positions as places in lists of values, as the encoder chooses them for regions whose coordinates repeat.
#include <algorithm>
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "client/decode/region_decoder.h"
#include "server/encode/region_encoder.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// A flight of steps with a well in it: every coordinate is that of many vertices.
RandomManifold steps(int size = 24) {
  RandomManifold mesh = split_fans(shapes::grid_with_holes(size, size, 3));
  for (Vec3& p : mesh.positions) {
    const int i = static_cast<int>(std::lround(p.x)), j = static_cast<int>(std::lround(p.y));
    p = {(i - 7) * 1.5 + i / 5, (j / 2 - 5) * 0.3, ((i / 4) * (j / 4) % 5) * 0.7 - 1};
  }
  return mesh;
}

RegionSource source_of(const RandomManifold& mesh, int bits = 14) {
  RegionSource source{mesh.table, {}, {}, {}};
  source.grid = make_grid(mesh.positions, bits);
  for (const Vec3& p : mesh.positions) source.positions.push_back(source.grid.quantise(p));
  return source;
}

RegionSource exact_source_of(const RandomManifold& mesh) {
  RegionSource source = source_of(mesh);
  source.positions.clear();
  for (const Vec3& p : mesh.positions) {
    const ExactPosition exact{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    source.exact.push_back(exact);
    source.positions.push_back(source.grid.quantise({exact[0], exact[1], exact[2]}));
  }
  return source;
}

DecodeLimits limits_of(const RegionSource& source, const EncodedRegion& encoded) {
  DecodeLimits limits{source.table.vertex_count(), source.table.triangle_count(), encoded.box.low,
                      encoded.box.high};
  if (!source.exact.empty()) limits.exact = source.grid;
  return limits;
}

/// The part, which must be in lists, and must give back what went in.
Bytes listed(const RegionSource& source) {
  EntropyEncoder symbols;
  const EncodedRegion encoded = encode_region(source, shipped_tables(), &symbols);
  EXPECT_TRUE(std::any_of(symbols.tokens().begin(), symbols.tokens().end(), [](const Token& token) {
    return token.model == region_model::kIsListed && token.symbol == 1;
  }));
  const auto decoded = decode_region(encoded.bytes, limits_of(source, encoded));
  EXPECT_TRUE(decoded) << decoded.error().message;
  if (!decoded) return encoded.bytes;
  EXPECT_TRUE(check_region_mesh(*decoded));
  EXPECT_EQ(decoded->loops.lengths, encoded.loops.lengths);
  for (VertexId v = 0; v < decoded->positions.size(); ++v) {
    const VertexId from = encoded.source_of_vertex[v];
    EXPECT_EQ(decoded->positions[v], source.positions[from]);
    for (std::size_t axis = 0; axis < (source.exact.empty() ? 0 : 3); ++axis) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(decoded->exact[v][axis]),
                std::bit_cast<std::uint32_t>(source.exact[from][axis]));
    }
  }
  return encoded.bytes;
}

TEST(ValueLists, TakeFewBitsWhereCoordinatesRepeat) {
  const RandomManifold mesh = steps();
  const auto vertices = static_cast<double>(mesh.positions.size());
  EXPECT_LT(8.0 * static_cast<double>(listed(source_of(mesh)).size()), 8 * vertices);
  EXPECT_LT(8.0 * static_cast<double>(listed(exact_source_of(mesh)).size()), 8 * vertices);
}

TEST(ValueLists, AreLeftAloneWhereCoordinatesDiffer) {
  const RegionSource source = source_of(split_fans(shapes::sphere(4)), 16);
  EntropyEncoder symbols;
  (void)encode_region(source, shipped_tables(), &symbols);
  EXPECT_TRUE(std::none_of(symbols.tokens().begin(), symbols.tokens().end(), [](const Token& token) {
    return token.model == region_model::kIsListed && token.symbol != 0;
  }));
}

TEST(ValueLists, HoldOddFloats) {
  RegionSource source = exact_source_of(steps());
  const auto set = [&](VertexId v, std::size_t axis, float value) {
    source.exact[v][axis] = value;
    const ExactPosition& exact = source.exact[v];
    source.positions[v] = source.grid.quantise({exact[0], exact[1], exact[2]});
  };
  set(0, 0, -0.0f);
  set(1, 0, 0.0f);
  set(40, 1, 1e-45f);
  set(41, 1, -1e-45f);
  set(42, 1, 0.1f);
  set(43, 2, 0.1234567f);  // of more digits than the others
  set(44, 2, -3.4028235e38f);
  set(45, 2, 3.4028235e38f);
  listed(source);
}

TEST(ValueLists, HoldSeveralPiecesAndOneOfOneValue) {
  TriangleSoup pieces = shapes::grid(12, 12);
  for (int i = 0; i < 12; ++i)
    shapes::append(pieces, shapes::translated(shapes::triangle(), {double(i), 1, 0}));
  for (int i = 0; i < 4; ++i) shapes::append(pieces, shapes::tetrahedron());
  listed(source_of(split_fans(pieces), 10));
  for (Vec3& p : pieces.positions) p.z = 0;  // flat: an axis of a single value, which takes no bits
  listed(source_of(split_fans(pieces), 10));
  listed(exact_source_of(split_fans(pieces)));
}

TEST(ValueLists, RefuseEveryTruncationAndSurviveEveryFlippedBit) {
  for (const RegionSource& source : {source_of(steps(9)), exact_source_of(steps(9))}) {
    const Bytes bytes = listed(source);
    const DecodeLimits limits = limits_of(source, encode_region(source));
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_FALSE(decode_region(std::span(bytes).first(length), limits)) << length;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      Bytes damaged = bytes;
      damaged[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
      const auto decoded = decode_region(damaged, limits);
      if (!decoded) continue;
      EXPECT_TRUE(check_region_mesh(*decoded));
      ASSERT_EQ(decoded->positions.size(), source.positions.size());
      for (const ExactPosition& exact : decoded->exact) {
        for (float x : exact) EXPECT_TRUE(std::isfinite(x));
      }
    }
  }
}

TEST(ValueLists, GiveNoPositionOutsideTheBox) {
  const RegionSource source = source_of(steps(9));
  const EncodedRegion encoded = encode_region(source);
  DecodeLimits limits = limits_of(source, encoded);
  --limits.box_max.x;
  EXPECT_EQ(decode_region(encoded.bytes, limits).error().code, ErrorCode::BadStream);
}

}  // namespace
}  // namespace selvage
