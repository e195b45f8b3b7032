// SPDX-License-Identifier: MIT
//
// The library's front door, against a real server.
#include "client/fetch/model.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "tests/support/fake_pack.h"
#include "tests/support/flaky_proxy.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/mesh_mirror.h"
#include "tests/support/shapes.h"
#include "tests/support/test_server.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;

/// A server with a torus in some regions.
class ModelTest : public ::testing::Test {
 protected:
  ModelTest() {
    server_.folder().put("torus.selvage", bytes_);
    whole_ = unpack(*Pack::from_bytes(bytes_).value()).value();
  }

  std::string address(const std::string& name = "torus") const {
    return server_.address().to_string() + "/" + name;
  }

  static bool same(const TriangleSoup& a, const TriangleSoup& b) { return compare_meshes(a, b, 0).same; }

  TriangleSoup soup_ = shapes::torus(60, 40);
  Bytes bytes_ = labelled_pack(soup_, cube_labels(soup_, 0.7), 14);
  StitchedMesh whole_;
  TestServer server_;
};

TEST_F(ModelTest, FetchesAllOfIt) {
  auto model = Model::open(address());
  ASSERT_TRUE(model) << model.error().message;
  std::set<RegionId> arrived;
  MeshMirror mirror;
  int updates = 0;
  FetchProgress last;
  FetchEvents events;
  events.on_region = [&](const ArrivedRegion& region) { EXPECT_TRUE(arrived.insert(region.region).second); };
  events.on_update = [&](const StitchUpdate& update) {
    mirror.apply(update);
    ++updates;
  };
  events.update_interval = 0ms;
  events.on_progress = [&](const FetchProgress& progress) { last = progress; };
  const auto fetched = model->fetch({}, events).wait();
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_TRUE(same(fetched->mesh.soup, whole_.soup));
  EXPECT_EQ(fetched->regions, model->directory().real_region_count());
  EXPECT_EQ(arrived.size(), fetched->regions);
  EXPECT_GT(updates, 1);
  EXPECT_TRUE(same(mirror.soup(), whole_.soup)) << "who applies every update has the mesh";
  EXPECT_EQ(last.regions, last.of_regions);
  EXPECT_EQ(last.bytes, last.of_bytes);
  EXPECT_EQ(last.parts, last.of_parts);
}

TEST_F(ModelTest, OpensPacksOnDiskToo) {
  const TempFolder folder;
  folder.put("torus.selvage", bytes_);
  auto model = Model::open((folder.path() / "torus.selvage").string());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_TRUE(same(model->fetch({}).wait()->mesh.soup, whole_.soup));
}

TEST_F(ModelTest, ShowsRegionsOfAServerInPlace) {
  auto model = Model::open(address());
  ASSERT_TRUE(model) << model.error().message;
  LiveModel live = model->live();
  MeshMirror mirror;
  FetchEvents events;
  events.on_update = [&](const StitchUpdate& update) { mirror.apply(update); };
  for (RegionId id = 1; id <= model->directory().real_region_count(); ++id)
    ASSERT_TRUE(live.show({.kind = Selection::Kind::Ids, .ids = {id}}, events));
  EXPECT_TRUE(same(mirror.soup(), whole_.soup));
}

TEST_F(ModelTest, UsesItsCacheAcrossModels) {
  const TempFolder folder;
  ModelOptions options;
  options.cache_folder = folder.path();
  auto first = Model::open(address(), options).value().fetch({}).wait();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->cached_parts, 0u);
  auto second = Model::open(address(), options).value().fetch({}).wait();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->parts, 0u);
  EXPECT_EQ(second->cached_parts, first->parts);
  EXPECT_TRUE(same(second->mesh.soup, whole_.soup));
}

TEST_F(ModelTest, ComesBackAfterBrokenConnections) {
  FlakyProxy proxy(server_.address(), bytes_.size() / 2);
  ModelOptions options;
  options.connection.window_bytes = 64u << 10;
  options.retry = {.first_delay = 1ms, .longest_delay = 2ms};
  std::atomic<int> retries = 0;
  FetchEvents events;
  events.on_retry = [&](const Error&, std::chrono::milliseconds) { ++retries; };
  auto model = Model::open(proxy.address().to_string() + "/torus", options);
  ASSERT_TRUE(model) << model.error().message;
  const auto fetched = model->fetch({}, events).wait();
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_TRUE(same(fetched->mesh.soup, whole_.soup));
  EXPECT_GT(fetched->retries, 0u);
  EXPECT_EQ(static_cast<std::uint32_t>(retries), fetched->retries);
}

TEST_F(ModelTest, CancelsFromAnEvent) {
  server_.folder().put("row.selvage", fake_pack_bytes(2000, 1000));
  auto model = Model::open(address("row"));
  ASSERT_TRUE(model);
  std::atomic<Fetch*> running = nullptr;
  FetchEvents events;
  events.on_progress = [&](const FetchProgress&) {
    if (Fetch* fetch = running) fetch->cancel();
  };
  Fetch fetch = model->fetch({}, events);
  running = &fetch;
  // Its parts are no regions, so it would fail in the end, and not so if it is cancelled first.
  EXPECT_FALSE(fetch.wait());
  EXPECT_TRUE(model->fetch({.kind = Selection::Kind::Ids, .ids = {9999}}).wait().error().code ==
              ErrorCode::NotFound)
      << "a model outlives its cancelled fetches";
}

TEST_F(ModelTest, CancelsWhenTheFetchGoes) {
  auto model = Model::open(address());
  ASSERT_TRUE(model);
  for (int i = 0; i < 20; ++i) model->fetch({});
  EXPECT_TRUE(model->fetch({}).wait());
}

TEST_F(ModelTest, MayBeReprioritisedAtAnyTime) {
  auto model = Model::open(address());
  ASSERT_TRUE(model);
  Fetch fetch = model->fetch({}, {}, 7);
  for (std::uint8_t urgency : {6, 0, 3}) fetch.reprioritise(urgency);
  EXPECT_TRUE(fetch.wait());
  fetch.reprioritise(1);
}

TEST_F(ModelTest, NamesItsSourceInErrors) {
  for (const auto& [source, code] : {std::pair(std::string("nonsense"), ErrorCode::InvalidArgument),
                                     {address("nothing"), ErrorCode::NotFound}}) {
    const auto model = Model::open(source);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, code);
    EXPECT_NE(model.error().message.find(source), std::string::npos) << model.error().message;
  }
}

TEST_F(ModelTest, SaysWhenThePackWasReplaced) {
  auto model = Model::open(address());
  ASSERT_TRUE(model);
  server_.folder().put("torus.selvage", fake_pack_bytes(3));
  // The server may still hold the old one; a new connection never gets it.
  auto fetched = model->fetch({}).wait();
  if (!fetched) {
    EXPECT_EQ(fetched.error().code, ErrorCode::ModelChanged);
  } else {
    EXPECT_TRUE(same(fetched->mesh.soup, whole_.soup));
  }
}

}  // namespace
}  // namespace selvage
