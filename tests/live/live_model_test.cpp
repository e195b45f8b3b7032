// SPDX-License-Identifier: MIT
#include "client/live/live_model.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "common/pack/pack.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/mesh_mirror.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// Answers like a server, from memory; can break off.
struct FakeServer {
  TriangleSoup soup = shapes::torus(24, 60);
  std::shared_ptr<const Pack> pack =
      Pack::from_bytes(labelled_pack(soup, cube_labels(soup, 1.5), 14)).value();
  std::uint32_t fails_after = 0xFFFFFFFFu;  // parts
  std::vector<PartId> sent;

  std::shared_ptr<const Manifest> manifest() const {
    auto manifest = std::make_shared<Manifest>();
    manifest->name = "model";
    manifest->pack_id = pack->id();
    manifest->directory = pack->directory();
    return manifest;
  }

  Result<GetStats> get(const GetRequest& request, const BlockingClient::OnPart& on_part) {
    GetStats stats;
    auto parts = select_parts(pack->directory(), request.selection);
    if (!parts) return forward_error(parts);
    for (const PartId& id : *parts) {
      const PartRef& ref = *pack->directory().find(id);
      if (std::find(request.have.begin(), request.have.end(), ref.hash) != request.have.end()) {
        ++stats.held;
        continue;
      }
      if (fails_after-- == 0) return fail(ErrorCode::Unavailable, "gone");
      const auto bytes = pack->part(ref);
      sent.push_back(id);
      ReceivedPart part;
      part.id = id;
      part.bytes.assign(bytes.begin(), bytes.end());
      if (auto ok = on_part(std::move(part)); !ok) return forward_error(ok);
      ++stats.parts;
      stats.bytes += ref.size;
    }
    return stats;
  }
};

struct Viewer {
  FakeServer server;
  MeshMirror mirror;
  int updates = 0;
  LiveModel live{server.manifest(),
                 [this](auto request, const auto& on_part) { return server.get(request, on_part); }};

  std::function<void(const StitchUpdate&)> draw = [this](const StitchUpdate& update) {
    mirror.apply(update);
    ++updates;
  };
  void expect_mirror_shows_the_mesh() const {
    const auto comparison = compare_meshes(live.mesh().soup, mirror.soup(), 0);
    EXPECT_TRUE(comparison.same) << comparison.difference;
  }
};

Selection ids(std::vector<RegionId> regions) {
  return {.kind = Selection::Kind::Ids, .ids = std::move(regions)};
}

TEST(LiveModel, ShowsTheWholeModelFromUpdatesAlone) {
  Viewer viewer;
  ASSERT_TRUE(viewer.live.show({}, viewer.draw));
  const auto comparison =
      compare_meshes(viewer.server.soup, viewer.mirror.soup(), viewer.server.pack->directory().grid.step / 2);
  EXPECT_TRUE(comparison.same) << comparison.difference;
}

TEST(LiveModel, FetchesNothingTwice) {
  Viewer viewer;
  std::mt19937 random(1);
  const RegionId regions = viewer.live.directory().real_region_count();
  for (int round = 0; round < 30; ++round) {
    std::vector<RegionId> two;
    for (int i = 0; i < 2; ++i) two.push_back(static_cast<RegionId>(1 + random() % regions));
    ASSERT_TRUE(viewer.live.show(ids(two), viewer.draw));
  }
  ASSERT_TRUE(viewer.live.show({}, viewer.draw));
  std::set<PartId> seen;
  for (const PartId& id : viewer.server.sent) EXPECT_TRUE(seen.insert(id).second);
  viewer.expect_mirror_shows_the_mesh();
  EXPECT_EQ(viewer.live.mesh().soup.triangles.size(), viewer.server.soup.triangles.size());
}

TEST(LiveModel, JoinsRegionsOfDifferentRequests) {
  Viewer viewer;
  const RegionId regions = viewer.live.directory().real_region_count();
  for (RegionId id = 1; id <= regions; ++id) ASSERT_TRUE(viewer.live.show(ids({id}), viewer.draw));
  EXPECT_EQ(viewer.live.mesh().soup.triangles.size(), viewer.server.soup.triangles.size());
  viewer.expect_mirror_shows_the_mesh();
}

TEST(LiveModel, HidesAndShowsAgainWithoutFetchingJoins) {
  Viewer viewer;
  ASSERT_TRUE(viewer.live.show({}, viewer.draw));
  const std::vector<RegionId> hidden = {2, 3};
  viewer.live.hide(hidden, viewer.draw);
  viewer.expect_mirror_shows_the_mesh();
  EXPECT_EQ(viewer.live.level_of(2), std::nullopt);
  EXPECT_LT(viewer.mirror.soup().triangles.size(), viewer.server.soup.triangles.size());
  viewer.server.sent.clear();
  const auto stats = viewer.live.show({}, viewer.draw);
  ASSERT_TRUE(stats);
  EXPECT_EQ(viewer.server.sent, (std::vector<PartId>{{PartKind::Region, 2, 0}, {PartKind::Region, 3, 0}}));
  viewer.expect_mirror_shows_the_mesh();
}

TEST(LiveModel, TriesAgainAfterTheConnectionBroke) {
  Viewer viewer;
  bool is_there = false;
  for (std::uint32_t parts = 0; !is_there; ++parts) {
    viewer.server.fails_after = parts;
    is_there = viewer.live.show({}, viewer.draw).has_value();
    viewer.expect_mirror_shows_the_mesh();
  }
  EXPECT_EQ(viewer.live.mesh().soup.triangles.size(), viewer.server.soup.triangles.size());
}

TEST(LiveModel, AsksNobodyForWhatIsThere) {
  Viewer viewer;
  ASSERT_TRUE(viewer.live.show(ids({4}), viewer.draw));
  viewer.updates = 0;
  viewer.server.fails_after = 0;
  const auto stats = viewer.live.show(ids({4}), viewer.draw);
  ASSERT_TRUE(stats);
  EXPECT_EQ(stats->parts, 0u);
  EXPECT_EQ(viewer.updates, 0);
}

TEST(LiveModel, PassesOnWhyASelectionIsWrong) {
  Viewer viewer;
  const auto stats = viewer.live.show(ids({99999}), viewer.draw);
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace selvage
