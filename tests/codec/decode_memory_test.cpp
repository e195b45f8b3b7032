// SPDX-License-Identifier: MIT
//
// Decoders take no more memory than they state, whatever the bytes.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "common/pack/pack.h"
#include "server/encode/region_encoder.h"
#include "tests/codec/heap_peak.h"
#include "tests/fuzz/part_input.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/random_meshes.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

std::vector<Bytes> corpus(const char* target) {
  std::vector<std::filesystem::path> paths;
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(SELVAGE_FUZZ_CORPUS_DIR) + "/" + target))
    paths.push_back(file.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> inputs;
  for (const auto& path : paths) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> chars(std::istreambuf_iterator<char>(in), {});
    const auto bytes = std::as_bytes(std::span(chars));
    inputs.emplace_back(bytes.begin(), bytes.end());
  }
  return inputs;
}

/// Tables are made once a program.
const CodecTables& tables = shipped_tables();

void expect_bounded(const RegionInput& input) {
  const HeapPeak peak;
  const auto region = decode_region(input.part, input.expected, tables);
  EXPECT_LE(peak.bytes(), decode_memory_bound(input.expected)) << input.expected.vertices << " vertices";
}

void expect_bounded(const BundleInput& input) {
  const BundleTopology topology = input.topology();
  const HeapPeak peak;
  const auto bundle = decode_bundle(input.part, topology, input.triangles, tables);
  EXPECT_LE(peak.bytes(), decode_memory_bound(topology, input.triangles)) << input.triangles << " triangles";
}

/// The input, and a thousand of it with some bytes changed; the header, too, promises what it likes.
void for_damaged(const Bytes& bytes, const std::function<void(std::span<const std::byte>)>& visit) {
  visit(bytes);
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round) {
    Bytes damaged = bytes;
    for (unsigned i = 0; i < 1 + random() % 4; ++i)
      damaged[random() % std::min<std::size_t>(damaged.size(), random() % 2 ? 40 : damaged.size())] =
          static_cast<std::byte>(random());
    visit(damaged);
  }
}

TEST(DecodeMemory, OfDamagedPartsStaysWithinTheBound) {
  for (const Bytes& input : corpus("fuzz_region"))
    for_damaged(input, [](auto bytes) { expect_bounded(read_region_input(bytes)); });
  for (const Bytes& input : corpus("fuzz_bundle"))
    for_damaged(input, [](auto bytes) { expect_bounded(read_bundle_input(bytes)); });
}

/// Where what grows with the part outweighs the rest by far.
void expect_bounded_when_large(const TriangleSoup& soup) {
  SCOPED_TRACE(soup.triangles.size());
  const RandomManifold mesh = split_fans(soup);
  RegionSource source{mesh.table, {}, {}, {}};
  source.grid = make_grid(mesh.positions, 12);
  for (const Vec3& p : mesh.positions) {
    source.positions.push_back(source.grid.quantise(p));
    source.exact.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    source.weld_groups.push_back(static_cast<std::uint32_t>(source.weld_groups.size()));
  }
  source.is_turned.assign(mesh.table.triangle_count(), true);
  const EncodedRegion encoded = encode_region(source);
  RegionInput input;
  input.expected = {mesh.table.vertex_count(), mesh.table.triangle_count(), encoded.box.low, encoded.box.high,
                    source.grid};
  input.part = encoded.bytes;
  ASSERT_TRUE(decode_region(input.part, input.expected, tables));
  expect_bounded(input);
  source.exact.clear();
  const Bytes without = encode_region(source).bytes;
  input.expected.exact.reset();
  input.part = without;
  ASSERT_TRUE(decode_region(input.part, input.expected, tables));
  expect_bounded(input);
}

TEST(DecodeMemory, OfLargeRegionsStaysWithinTheBound) {
  TriangleSoup dust;
  for (int i = 0; i < 5000; ++i) shapes::append(dust, shapes::triangle());
  for (const TriangleSoup& soup : {shapes::grid(120, 120), shapes::torus(100, 150),
                                   shapes::chain_of_tori(200), shapes::grid_with_holes(120, 120, 3), dust})
    expect_bounded_when_large(soup);
}

TEST(DecodeMemory, OfListsStaysWithinTheBound) {
  TriangleSoup steps = shapes::grid(120, 120);
  for (Vec3& p : steps.positions) p.z = static_cast<int>(p.x / 3) % 7 * (static_cast<int>(p.y / 4) % 3);
  TriangleSoup dust;
  for (int i = 0; i < 5000; ++i)
    shapes::append(dust, shapes::translated(shapes::triangle(), {double(i % 70), double(i / 70), 0}));
  for (const TriangleSoup& soup : {steps, dust}) expect_bounded_when_large(soup);
}

TEST(DecodeMemory, OfLargeBundlesStaysWithinTheBound) {
  const TriangleSoup soup = shapes::torus(100, 300);
  for (const double cell : {0.2, 0.6, 2.0}) {
    const auto pack = Pack::from_bytes(labelled_pack(soup, cube_labels(soup, cell), 14)).value();
    const auto& regions = pack->directory().regions;
    for (const RegionEntry& entry : regions) {
      if (entry.bundle.size == 0) continue;
      BundleInput input;
      for (const RegionId id : entry.lower_neighbours) input.loops.push_back(regions[id].loop_lengths);
      input.loops.push_back(entry.loop_lengths);
      input.triangles = entry.bundle_triangles;
      input.part = pack->part(entry.bundle);
      ASSERT_TRUE(decode_bundle(input.part, input.topology(), input.triangles, tables));
      expect_bounded(input);
    }
  }
}

}  // namespace
}  // namespace selvage
