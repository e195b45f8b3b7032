// SPDX-License-Identifier: MIT
#include "client/stitch/stitcher.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "client/decode/region_decoder.h"
#include "common/mesh/same_mesh.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

struct Patches {
  TriangleSoup soup = shapes::torus(24, 60);
  std::shared_ptr<const Pack> pack =
      Pack::from_bytes(labelled_pack(soup, cube_labels(soup, 1.5), 14)).value();
  const Directory& directory = pack->directory();
  std::vector<PartId> parts = select_parts(directory, {}).value();

  std::span<const std::byte> bytes(const PartId& id) const { return pack->part(*directory.find(id)); }
  RegionMesh region(RegionId id) const {
    const RegionEntry& entry = directory.regions[id];
    const LevelEntry& level = entry.levels[0];
    return decode_region(pack->part(level.part),
                         {level.vertices, level.triangles, entry.box_min, entry.box_max})
        .value();
  }
};

TEST(Stitcher, GivesTheSameMeshForAnyOrderOfParts) {
  Patches patches;
  std::mt19937 random(3);
  for (int round = 0; round < 10; ++round) {
    std::shuffle(patches.parts.begin(), patches.parts.end(), random);
    PartCollector collector(patches.directory);
    for (const PartId& id : patches.parts) ASSERT_TRUE(collector.add(id, patches.bytes(id)));
    const MeshComparison comparison =
        compare_meshes(patches.soup, collector.mesh().soup, patches.directory.grid.step / 2);
    EXPECT_TRUE(comparison.same) << comparison.difference;
  }
}

TEST(Stitcher, ShowsABoundaryTriangleOnceItsRegionsAreThereAndNoSooner) {
  const Patches patches;
  PartCollector collector(patches.directory);
  for (const PartId& id : patches.parts) {
    if (id.kind != PartKind::Bundle) continue;
    ASSERT_TRUE(collector.add(id, patches.bytes(id)));
  }
  EXPECT_TRUE(collector.mesh().soup.triangles.empty());
  std::size_t before = 0, interior = 0;
  for (const PartId& id : patches.parts) {
    if (id.kind == PartKind::Bundle) continue;
    ASSERT_TRUE(collector.add(id, patches.bytes(id)));
    interior += patches.directory.regions[id.region].levels[0].triangles;
    const std::size_t now = collector.mesh().soup.triangles.size();
    EXPECT_GE(now, interior);
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_EQ(before, patches.soup.triangles.size());
}

TEST(Stitcher, AddingAPartTwiceChangesNothing) {
  const Patches patches;
  PartCollector collector(patches.directory);
  for (int round = 0; round < 2; ++round) {
    for (const PartId& id : patches.parts) ASSERT_TRUE(collector.add(id, patches.bytes(id)));
  }
  EXPECT_EQ(collector.mesh().soup.triangles.size(), patches.soup.triangles.size());
}

TEST(Stitcher, RefusesARegionWhoseLoopsAreNotTheDirectorys) {
  const Patches patches;
  Stitcher stitcher(patches.directory);
  RegionMesh mesh = patches.region(1);
  ++mesh.loops.lengths.front();
  const auto added = stitcher.add_region(1, std::move(mesh));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::BadStream);
}

TEST(Stitcher, RefusesACornerBeyondItsRegionsLoops) {
  const Patches patches;
  Stitcher stitcher(patches.directory);
  const std::uint32_t count = patches.directory.regions[1].boundary_vertices();
  EXPECT_FALSE(stitcher.add_bundle(2, {{{BoundaryRef{1, count}, {2, 0}, {2, 1}}, false}}));
  const auto regions = static_cast<RegionId>(patches.directory.regions.size());
  EXPECT_FALSE(stitcher.add_bundle(2, {{{BoundaryRef{regions, 0}, {2, 0}, {2, 1}}, false}}));
}

TEST(PartCollector, NamesThePartThatIsMalformed) {
  const Patches patches;
  PartCollector collector(patches.directory);
  const PartId id{PartKind::Region, 3, 0};
  const auto bytes = patches.bytes(id);
  const auto added = collector.add(id, bytes.first(bytes.size() - 1));
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("region 3"), std::string::npos);
  EXPECT_FALSE(collector.add({PartKind::Region, 3, 7}, bytes));
}

}  // namespace
}  // namespace selvage
