// SPDX-License-Identifier: MIT
//
// Decodes region parts and bundles as the fuzz corpora hold them and prints a digest of what came out: built
// natively and for WebAssembly, it must print the same.
#include <bit>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/fuzz/part_input.h"

namespace selvage {
namespace {

struct Digest {
  std::uint64_t value = 14695981039346656037u;
  void add(std::uint64_t number) { value = (value ^ number) * 1099511628211u; }
};

void digest_region(std::span<const std::byte> bytes, Digest& digest) {
  const RegionInput input = read_region_input(bytes);
  const auto region = decode_region(input.part, input.expected);
  digest.add(region.has_value());
  if (!region) return;
  for (const Triangle& triangle : region->triangles) {
    for (VertexId v : triangle) digest.add(v);
  }
  for (const GridPoint& p : region->positions)
    digest.add(static_cast<std::uint64_t>(p.x) << 40 ^ static_cast<std::uint64_t>(p.y) << 20 ^
               static_cast<std::uint64_t>(p.z));
  for (VertexId v : region->vertex_of_boundary) digest.add(v);
  for (const ExactPosition& exact : region->exact) {
    for (float x : exact) digest.add(std::bit_cast<std::uint32_t>(x));
  }
}

void digest_bundle(std::span<const std::byte> bytes, Digest& digest) {
  const BundleInput input = read_bundle_input(bytes);
  const auto decoded = decode_bundle(input.part, input.topology(), input.triangles);
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
    Digest digest;
    digest.add(bytes.size());
    path.find("fuzz_bundle") != std::string::npos ? digest_bundle(bytes, digest)
                                                  : digest_region(bytes, digest);
    std::printf("%s %016llx\n", path.substr(path.rfind('/') + 1).c_str(),
                static_cast<unsigned long long>(digest.value));
  }
}
