// SPDX-License-Identifier: MIT
//
// The format does not change by accident: the packs in this folder are what today's encoder writes, byte for
// byte, and what every later decoder reads. The seeds of the fuzz targets are their parts. A change of format
// that is meant writes them all anew:
//   SELVAGE_WRITE_GOLDEN=1 build/release/tests/golden_test
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "tests/golden/fuzz_seeds.h"
#include "tests/golden/golden_packs.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

std::string path_of(const GoldenPack& golden) {
  return std::string(SELVAGE_GOLDEN_DIR) + "/" + golden.name + ".selvage";
}

bool is_to_write() { return std::getenv("SELVAGE_WRITE_GOLDEN") != nullptr; }

void write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Bytes read_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> chars(std::istreambuf_iterator<char>(in), {});
  const auto bytes = std::as_bytes(std::span(chars));
  return {bytes.begin(), bytes.end()};
}

TEST(Golden, EncoderWritesTheSameBytes) {
  for (const GoldenPack& golden : golden_packs()) {
    const Bytes bytes =
        labelled_pack(golden.soup, golden.labels, golden.bits, golden.is_exact, golden.level_ratios);
    if (is_to_write()) write_bytes(path_of(golden), bytes);
    EXPECT_EQ(bytes, read_bytes(path_of(golden))) << golden.name;
  }
}

TEST(Golden, DecoderRestoresTheMesh) {
  for (const GoldenPack& golden : golden_packs()) {
    SCOPED_TRACE(golden.name);
    const auto pack = Pack::from_bytes(read_bytes(path_of(golden)));
    ASSERT_TRUE(pack) << pack.error().message;
    const auto stitched = unpack(**pack);
    ASSERT_TRUE(stitched) << stitched.error().message;
    const double tolerance = golden.is_exact ? 0 : (*pack)->directory().grid.step / 2;
    const MeshComparison comparison = compare_meshes(golden.soup, stitched->soup, tolerance);
    EXPECT_TRUE(comparison.same) << comparison.difference;
  }
}

TEST(Golden, FuzzTargetsStartFromItsParts) {
  for (const GoldenPack& golden : golden_packs()) {
    const auto pack = Pack::from_bytes(read_bytes(path_of(golden)));
    ASSERT_TRUE(pack) << pack.error().message;
    const auto seeds = fuzz_seeds(**pack, golden.name);
    EXPECT_FALSE(seeds.empty()) << golden.name;
    for (const auto& [name, bytes] : seeds) {
      const std::string path = std::string(SELVAGE_FUZZ_CORPUS_DIR) + "/" + name;
      if (is_to_write()) write_bytes(path, bytes);
      EXPECT_EQ(bytes, read_bytes(path)) << name;
    }
  }
}

}  // namespace
}  // namespace selvage
