// SPDX-License-Identifier: MIT
//
// A client that knows what it wants asks for it before the server has said anything.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "client/fetch/list_models.h"
#include "client/fetch/model.h"
#include "client/session/blocking_client.h"
#include "common/mesh/same_mesh.h"
#include "tests/support/fake_pack.h"
#include "tests/support/flaky_proxy.h"
#include "tests/support/holding_proxy.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"
#include "tests/support/test_server.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;

/// A server with a torus in so many regions that its directory has several pages.
class OneFlight : public ::testing::Test {
 protected:
  OneFlight() { server_.folder().put("torus.selvage", bytes_); }

  static bool same(const TriangleSoup& a, const TriangleSoup& b) { return compare_meshes(a, b, 0).same; }
  StitchedMesh unpacked(const Selection& selection) const { return unpack(*pack_, selection).value(); }

  TriangleSoup soup_ = shapes::torus(240, 160);
  Bytes bytes_ = labelled_pack(soup_, cube_labels(soup_, 0.15), 14);
  std::shared_ptr<const Pack> pack_ = Pack::from_bytes(bytes_).value();
  TestServer server_;
};

TEST_F(OneFlight, BringsTheMeshHoweverItIsSelected) {
  ASSERT_GE(pack_->directory().pages.size(), 3u);
  const RegionId last = pack_->directory().real_region_count();
  for (const Selection& selection :
       {Selection{}, Selection{.level = 1}, Selection{.joins = Joins::None},
        Selection{.kind = Selection::Kind::Ids, .ids = {last, 1, 300}},
        Selection{.kind = Selection::Kind::Ids, .ids = {last, 1, 300}, .joins = Joins::All},
        Selection{.kind = Selection::Kind::Box, .box = {{-10, -10, -10}, {0, 0, 10}}}}) {
    HoldingProxy proxy(server_.address(), FrameType::GetParts);
    auto model = Model::at(proxy.address().to_string() + "/torus");
    ASSERT_TRUE(model) << model.error().message;
    const auto fetched = model->fetch(selection).wait();
    ASSERT_TRUE(fetched) << fetched.error().message;
    EXPECT_TRUE(same(fetched->mesh.soup, unpacked(selection).soup));
    EXPECT_EQ(proxy.sent(FrameType::Hello), 1);
    EXPECT_EQ(proxy.sent(FrameType::OpenModel), 1);
    EXPECT_EQ(proxy.sent(FrameType::GetParts), 1);
  }
}

TEST_F(OneFlight, TakesNoMoreOfTheDirectoryThanItNeeds) {
  auto model = Model::at(server_.address().to_string() + "/torus");
  const Selection one{.kind = Selection::Kind::Ids, .ids = {300}};
  ASSERT_TRUE(model->fetch(one).wait());
  EXPECT_TRUE(model->directory().has(300));
  EXPECT_FALSE(model->directory().is_complete());
  EXPECT_LT(model->directory_bytes(), pack_->directory_bytes().size());

  const auto whole = model->fetch({}).wait();
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_TRUE(same(whole->mesh.soup, unpacked({}).soup));
  EXPECT_TRUE(model->directory().is_complete());
}

TEST_F(OneFlight, TellsOfEverythingOnTheWay) {
  auto model = Model::at(server_.address().to_string() + "/torus");
  FetchEvents events;
  FetchProgress last;
  std::map<RegionId, int> arrived;
  events.on_progress = [&](const FetchProgress& progress) { last = progress; };
  events.on_region = [&](const ArrivedRegion& region) { ++arrived[region.region]; };
  ASSERT_TRUE(model->fetch({}, events).wait());
  EXPECT_EQ(arrived.size(), pack_->directory().real_region_count());
  EXPECT_EQ(last.regions, last.of_regions);
  EXPECT_EQ(last.parts, last.of_parts);
  EXPECT_EQ(last.bytes, last.of_bytes);
}

TEST_F(OneFlight, GoesOnAfterBrokenConnectionsWithoutFetchingAnythingTwice) {
  const std::size_t parts = select_parts(pack_->directory(), {})->size();
  for (std::size_t budget = 1000; budget < bytes_.size(); budget = budget * 3 / 2) {
    FlakyProxy proxy(server_.address(), budget);
    ModelOptions options;
    options.retry_open = true;
    options.retry = {.first_delay = 1ms, .longest_delay = 2ms};
    auto model = Model::at(proxy.address().to_string() + "/torus", options);
    FetchEvents events;
    events.on_retry = [&](const Error&, auto) {
      if (proxy.connections() >= 2) proxy.heal();
    };
    const auto fetched = model->fetch({}, events).wait();
    ASSERT_TRUE(fetched) << fetched.error().message;
    EXPECT_TRUE(same(fetched->mesh.soup, unpacked({}).soup));
    EXPECT_EQ(fetched->parts, parts);
  }
}

TEST_F(OneFlight, FailsAtOnceWhereNobodyListens) {
  HostPort nobody;
  {
    TestServer gone;
    nobody = gone.address();
  }
  const auto fetched = Model::at(nobody.to_string() + "/torus")->fetch({}).wait();
  ASSERT_FALSE(fetched);
  EXPECT_NE(fetched.error().message.find(nobody.to_string()), std::string::npos) << fetched.error().message;
}

TEST_F(OneFlight, PassesOnWhatTheServerHasAgainstIt) {
  const std::string server = server_.address().to_string();
  const auto unknown = Model::at(server + "/nothing")->fetch({}).wait();
  EXPECT_EQ(unknown.error().code, ErrorCode::NotFound);
  const auto beyond =
      Model::at(server + "/torus")->fetch({.kind = Selection::Kind::Ids, .ids = {99'999}}).wait();
  EXPECT_EQ(beyond.error().code, ErrorCode::NotFound);
  const auto unnamed =
      Model::at(server + "/torus")->fetch({.kind = Selection::Kind::Ids, .names = {"wheel"}}).wait();
  EXPECT_EQ(unnamed.error().code, ErrorCode::NotFound);
  EXPECT_NE(unnamed.error().message.find("wheel"), std::string::npos);
}

TEST_F(OneFlight, AsksNotForWhatItsCacheHas) {
  const TempFolder folder;
  ModelOptions options;
  options.cache_folder = folder.path();
  const std::string source = server_.address().to_string() + "/torus";
  const Selection some{.kind = Selection::Kind::Ids, .ids = {1, 2, 3}};
  const auto first = Model::at(source, options)->fetch(some).wait();
  ASSERT_TRUE(first);
  EXPECT_GT(first->parts, 0u);
  const auto again = Model::at(source, options)->fetch(some).wait();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->parts, 0u);
  EXPECT_EQ(again->cached_parts, first->parts);
}

TEST_F(OneFlight, ListsAfterOneFlightToo) {
  HoldingProxy proxy(server_.address(), FrameType::ListModels);
  const auto models = list_models(proxy.address().to_string());
  ASSERT_TRUE(models) << models.error().message;
  EXPECT_EQ(models->size(), 1u);
}

/// Parts 256 apart have the same bytes, and the same hash.
TEST(FirstRequest, BringsThePartsThatTheDirectorySelects) {
  TestServer server;
  const auto bytes = fake_pack_bytes(700, 300);
  server.folder().put("row.selvage", bytes);
  const auto pack = Pack::from_bytes(bytes).value();
  for (const Joins joins : {Joins::None, Joins::Closure, Joins::All}) {
    for (const Selection& selection :
         {Selection{.joins = joins},
          Selection{.kind = Selection::Kind::Ids, .ids = {511, 512}, .joins = joins},
          Selection{.kind = Selection::Kind::Box, .box = {{200, 0, 0}, {300, 1, 1}}, .joins = joins}}) {
      auto client = BlockingClient::connect(server.address()).value();
      std::optional<Manifest> manifest;
      std::vector<PartId> came;
      const auto on_manifest = [&](Manifest opened) -> Result<void> {
        manifest = std::move(opened);
        return {};
      };
      const auto on_part = [&](ReceivedPart part) -> Result<void> {
        if (part.id.kind == PartKind::Page) return read_page(manifest->directory, part.id.region, part.bytes);
        EXPECT_TRUE(manifest->directory.has(part.id.region)) << "a part before the page that lists it";
        came.push_back(part.id);
        return {};
      };
      const auto stats = client.open_and_get("row", {selection}, on_manifest, on_part);
      ASSERT_TRUE(stats) << stats.error().message;
      auto expected = select_parts(pack->directory(), selection).value();
      EXPECT_EQ(came, expected);
      EXPECT_EQ(stats->parts, expected.size());
      EXPECT_EQ(manifest->directory.is_complete(), pages_for(selection) == Pages::All);
    }
  }
}

}  // namespace
}  // namespace selvage
