// SPDX-License-Identifier: MIT
//
// print_pack PACK...: decodes every part of packs and prints what it holds, line by line, for comparison with
// what print_pack.py makes of the same bytes.
#include <bit>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "client/decode/bundle_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/pack/pack.h"

namespace selvage {
namespace {

void print_region(const RegionMesh& mesh, RegionId region, std::size_t level) {
  std::printf("region %u level %zu\n", region, level);
  for (TriangleId t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    std::printf("t %u %u %u %d\n", a, b, c, !mesh.is_turned.empty() && mesh.is_turned[t]);
  }
  for (VertexId v = 0; v < mesh.positions.size(); ++v) {
    const GridPoint& p = mesh.positions[v];
    std::printf("v %d %d %d", p.x, p.y, p.z);
    for (int axis = 0; axis < 3 && !mesh.exact.empty(); ++axis)
      std::printf(" %u", std::bit_cast<std::uint32_t>(mesh.exact[v][static_cast<std::size_t>(axis)]));
    std::printf("\n");
  }
  std::printf("b");
  for (const VertexId v : mesh.vertex_of_boundary) std::printf(" %u", v);
  std::printf("\n");
  for (const Anchor& anchor : mesh.anchors) std::printf("a %u %u\n", anchor.vertex, anchor.group);
}

bool print_levels(const Pack& pack, RegionId region) {
  const Directory& directory = pack.directory();
  const RegionEntry& entry = directory.regions[region];
  for (std::size_t i = 0; i < entry.levels.size(); ++i) {
    const LevelEntry& level = entry.levels[i];
    if (level.is_repeat) continue;
    DecodeLimits limits{level.vertices, level.triangles, entry.box_min, entry.box_max};
    if (i == 0 && directory.is_exact) limits.exact = directory.grid;
    if (i > 0) limits.coarse = CoarseLevel{entry.loop_lengths, level.dropped_bits};
    const auto mesh = decode_region(pack.part(level.part), limits);
    if (!mesh) return false;
    print_region(*mesh, region, i);
  }
  return true;
}

bool print_bundle(const Pack& pack, RegionId region) {
  const auto& entries = pack.directory().regions;
  const RegionEntry& entry = entries[region];
  std::vector<BundleTopology::Region> loops;
  for (const RegionId lower : entry.lower_neighbours) loops.push_back({lower, entries[lower].loop_lengths});
  loops.push_back({region, entry.loop_lengths});
  const auto triangles =
      decode_bundle(pack.part(entry.bundle), BundleTopology(std::move(loops)), entry.bundle_triangles);
  if (!triangles) return false;
  std::printf("bundle %u\n", region);
  for (const BoundaryTriangle& triangle : *triangles) {
    std::printf("t");
    for (const BoundaryRef& corner : triangle.corners) std::printf(" %u %u", corner.region, corner.index);
    std::printf(" %d\n", triangle.is_turned);
  }
  return true;
}

bool print_pack(const char* path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> chars(std::istreambuf_iterator<char>(in), {});
  const auto bytes = std::as_bytes(std::span(chars));
  const auto pack = Pack::from_bytes({bytes.begin(), bytes.end()});
  if (!pack) return false;
  for (RegionId region = 0; region < (*pack)->directory().regions.size(); ++region) {
    if (!print_levels(**pack, region)) return false;
    if ((*pack)->directory().regions[region].bundle.size > 0 && !print_bundle(**pack, region)) return false;
  }
  return true;
}

}  // namespace
}  // namespace selvage

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (selvage::print_pack(argv[i])) continue;
    std::fprintf(stderr, "%s: does not decode\n", argv[i]);
    return 1;
  }
}
