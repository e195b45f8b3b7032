// SPDX-License-Identifier: MIT
#include "client/fetch/live_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "common/pack/pack.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/levelled_model.h"
#include "tests/support/mesh_mirror.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

constexpr double kRatios[] = {0.5, 0.2, 0.05};

LevelledModel model_of(const TriangleSoup& soup) {
  RepairedMesh mesh = repair(soup).value();
  const auto labels = cube_labels({mesh.positions, {}}, 1.5);
  return levelled_model("model", std::move(mesh), labels, kRatios);
}

/// Answers like a server, from memory; can break off.
struct FakeServer final : PartSource {
  TriangleSoup soup = shapes::torus(24, 60);
  LevelledModel model = model_of(soup);
  std::shared_ptr<const Pack> pack = Pack::from_bytes(levelled_pack(model, 14)).value();
  std::uint32_t fails_after = 0xFFFFFFFFu;  // parts
  std::vector<PartId> sent;

  Result<std::shared_ptr<const Manifest>> open(std::stop_token) override {
    auto manifest = std::make_shared<Manifest>();
    manifest->name = "model";
    manifest->pack_id = pack->id();
    manifest->directory = pack->directory();
    return manifest;
  }

  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token) override {
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
  LiveModel live{std::make_shared<Manifest>(*server.open({}).value()), server, impatient()};

  FetchEvents draw = {.on_update =
                          [this](const StitchUpdate& update) {
                            EXPECT_FALSE(update.vertices.empty() && update.patches.empty() &&
                                         update.removed_vertices.empty());
                            mirror.apply(update);
                            ++updates;
                          },
                      .update_interval = std::chrono::milliseconds(0)};

  static ShowOptions impatient() {
    ShowOptions options;
    options.fetch.retry.give_up_after = std::chrono::milliseconds(0);
    return options;
  }
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
  viewer.live.hide(hidden, viewer.draw.on_update);
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
  EXPECT_EQ(stats->fetched.parts, 0u);
  EXPECT_EQ(viewer.updates, 0);
}

/// The mesh in the numbers of the file's vertices, by their places on the grid, which are all different.
std::vector<Triangle> in_file_vertices(const FakeServer& server, const TriangleSoup& soup) {
  const Grid& grid = server.pack->directory().grid;
  const auto place = [&](const Vec3& p) {
    const GridPoint g = grid.quantise(p);
    return std::array{g.x, g.y, g.z};
  };
  std::map<std::array<std::int32_t, 3>, VertexId> vertex_at;
  for (VertexId v = 0; v < server.soup.positions.size(); ++v)
    EXPECT_TRUE(vertex_at.emplace(place(server.soup.positions[v]), v).second);
  std::vector<Triangle> triangles = soup.triangles;
  for (Triangle& triangle : triangles) {
    for (VertexId& v : triangle) v = vertex_at.at(place(soup.positions[v]));
  }
  return in_canonical_order(std::move(triangles));
}

TEST(LiveModel, RefinesAndCoarsensInPlaceAndIsTheMixAtEveryStep) {
  Viewer viewer;
  std::mt19937 random(5);
  const Directory& directory = viewer.live.directory();
  ASSERT_EQ(directory.level_count(), 4u);
  ASSERT_TRUE(viewer.live.show({.level = 3}, viewer.draw));
  std::vector<std::uint32_t> levels(directory.regions.size(), 3);
  levels[kLooseRegion] = 0;
  for (int step = 0; step < 100; ++step) {
    Selection selection{.kind = Selection::Kind::Ids};
    for (int i = 0; i < 3; ++i) {
      const auto id = static_cast<RegionId>(1 + random() % directory.real_region_count());
      if (std::count(selection.ids.begin(), selection.ids.end(), id) > 0) continue;
      levels[id] = random() % 4;
      selection.ids.push_back(id);
      selection.levels.push_back({id, static_cast<std::uint8_t>(levels[id])});
    }
    viewer.server.sent.clear();
    ASSERT_TRUE(viewer.live.show(selection, viewer.draw));
    for (const PartId& id : viewer.server.sent) EXPECT_EQ(id.kind, PartKind::Region) << "a join came again";
    ASSERT_LE(viewer.server.sent.size(), selection.ids.size());
    const auto mix = viewer.server.model.mix(levels);
    ASSERT_EQ(in_file_vertices(viewer.server, viewer.mirror.soup()), mix) << "step " << step;
    ASSERT_EQ(in_file_vertices(viewer.server, viewer.live.mesh().soup), mix) << "step " << step;
  }
}

TEST(LiveModel, PassesOnWhyASelectionIsWrong) {
  Viewer viewer;
  const auto stats = viewer.live.show(ids({99999}), viewer.draw);
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace selvage
