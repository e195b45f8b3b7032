// SPDX-License-Identifier: MIT
//
// Decodes region parts and bundles as the fuzz corpora hold them and prints a digest of what came out: built
// natively and for WebAssembly, it must print the same. See tests/fuzz/fuzz_region.cpp and fuzz_bundle.cpp
// for the layout.
#include <bit>
#include <cstdio>
#include <string>
#include <vector>

#include "client/decode/bundle_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/coding/byte_io.h"

namespace selvage {
namespace {

struct Digest {
  std::uint64_t value = 14695981039346656037u;
  void add(std::uint64_t number) { value = (value ^ number) * 1099511628211u; }
};

void digest_region(ByteReader& in, Digest& digest) {
  DecodeLimits expected;
  expected.vertices = in.u16();
  expected.triangles = in.u16();
  const std::uint8_t flags = in.u8();
  if (flags & 1) expected.exact = Grid{.origin = {-1, 0, 1e-3}, .step = 1e-4, .bits = 24};
  for (int axis = 0; axis < 3; ++axis) expected.box_min[axis] = in.u16();
  for (int axis = 0; axis < 3; ++axis) expected.box_max[axis] = expected.box_min[axis] + in.u16();
  std::vector<std::uint32_t> loops;
  if (flags & 2) {
    const int dropped_bits = in.u8() % 16;
    loops.resize(in.u8());
    for (std::uint32_t& length : loops) length = in.u16();
    expected.coarse = CoarseLevel{loops, dropped_bits};
  }
  const auto region = decode_region(in.take(in.left()), expected);
  digest.add(region.has_value());
  if (!region) return;
  for (VertexId v : region->table.vertex_of_corner) digest.add(v);
  for (const GridPoint& p : region->positions)
    digest.add(static_cast<std::uint64_t>(p.x) << 40 ^ static_cast<std::uint64_t>(p.y) << 20 ^
               static_cast<std::uint64_t>(p.z));
  for (VertexId v : region->vertex_of_boundary) digest.add(v);
  for (const ExactPosition& exact : region->exact) {
    for (float x : exact) digest.add(std::bit_cast<std::uint32_t>(x));
  }
}

void digest_bundle(ByteReader& in, Digest& digest) {
  std::vector<std::vector<std::uint32_t>> loops(1 + in.u8() % 8);
  for (auto& lengths : loops) {
    lengths.resize(in.u8() % 8);
    for (std::uint32_t& length : lengths) length = 1 + in.u8();
  }
  const std::uint32_t triangles = in.u16();
  std::vector<BundleTopology::Region> regions;
  for (std::size_t i = 0; i < loops.size(); ++i) regions.push_back({static_cast<RegionId>(i + 1), loops[i]});
  const auto decoded = decode_bundle(in.take(in.left()), BundleTopology(std::move(regions)), triangles);
  digest.add(decoded.has_value());
  if (!decoded) return;
  for (const BoundaryTriangle& triangle : *decoded) {
    for (const BoundaryRef& corner : triangle.corners)
      digest.add(std::uint64_t{corner.region} << 32 | corner.index);
  }
}

Bytes read_all(const char* path) {
  Bytes bytes;
  std::FILE* file = std::fopen(path, "rb");
  for (int c; file != nullptr && (c = std::fgetc(file)) != EOF;) bytes.push_back(static_cast<std::byte>(c));
  if (file != nullptr) std::fclose(file);
  return bytes;
}

}  // namespace
}  // namespace selvage

int main(int argc, char** argv) {
  using namespace selvage;
  for (int i = 1; i < argc; ++i) {
    const std::string path = argv[i];
    const Bytes bytes = read_all(argv[i]);
    ByteReader in(bytes);
    Digest digest;
    digest.add(bytes.size());
    path.find("fuzz_bundle") != std::string::npos ? digest_bundle(in, digest) : digest_region(in, digest);
    std::printf("%s %016llx\n", path.substr(path.rfind('/') + 1).c_str(),
                static_cast<unsigned long long>(digest.value));
  }
}
