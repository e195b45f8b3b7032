// SPDX-License-Identifier: MIT
//
// Server and client over real sockets and threads.
#include <atomic>
#include <set>

#include <gtest/gtest.h>

#include "client/session/blocking_client.h"
#include "tests/support/fake_pack.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

constexpr auto ignore_part = [](ReceivedPart) { return Result<void>(); };

BlockingClient connect(const TestServer& server, ClientOptions options = {}) {
  auto client = BlockingClient::connect(server.address(), options);
  if (!client) throw std::runtime_error(client.error().message);
  return std::move(*client);
}

TEST(Loopback, ListsModelsWithDamagedOnes) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(5));
  server.folder().put("torn.selvage", Bytes(100));
  BlockingClient client = connect(server);
  const auto models = client.list();
  ASSERT_TRUE(models) << models.error().message;
  ASSERT_EQ(models->size(), 2u);
  EXPECT_EQ(models->at(0).name, "row");
  EXPECT_EQ(models->at(0).regions, 5u);
  EXPECT_EQ(models->at(0).problem, "");
  EXPECT_EQ(models->at(1).name, "torn");
  EXPECT_NE(models->at(1).problem, "");

  const auto torn = client.open("torn");
  ASSERT_FALSE(torn);
  EXPECT_EQ(torn.error().code, ErrorCode::BadStream);
  EXPECT_EQ(torn.error().message.find(server.folder().path().string()), std::string::npos);
}

TEST(Loopback, PagesThroughManyModels) {
  TestServer server;
  for (int i = 0; i < 1203; ++i) server.folder().put("m" + std::to_string(i) + ".selvage", Bytes(10));
  BlockingClient client = connect(server);
  const auto models = client.list();
  ASSERT_TRUE(models) << models.error().message;
  EXPECT_EQ(models->size(), 1203u);
}

TEST(Loopback, FetchesTheBytesOfThePack) {
  TestServer server;
  const auto bytes = fake_pack_bytes(200, 5000);
  server.folder().put("row.selvage", bytes);
  const auto pack = Pack::from_bytes(bytes).value();
  BlockingClient client = connect(server);
  const auto manifest = client.open("row");
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_EQ((*manifest)->pack_id, pack->id());
  EXPECT_EQ((*manifest)->directory.real_region_count(), 200u);

  std::set<PartId> seen;
  const auto stats =
      client.get({*manifest, {.kind = Selection::Kind::All}}, [&](ReceivedPart part) -> Result<void> {
        EXPECT_TRUE(seen.insert(part.id).second);
        const auto expected = pack->part(*pack->directory().find(part.id));
        EXPECT_TRUE(std::ranges::equal(part.bytes, expected));
        return {};
      });
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 399u);
  EXPECT_EQ(seen.size(), 399u);
  EXPECT_EQ(stats->bytes, 200u * 5000 + 199 * 3);
}

TEST(Loopback, FetchesPartsLargerThanTheWindow) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3, 1 << 20));
  BlockingClient client = connect(server, {.window_bytes = kMinInitialCredit});
  const auto manifest = client.open("row").value();
  const auto stats = client.get({manifest, {.kind = Selection::Kind::All}}, ignore_part);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 5u);
}

TEST(Loopback, OpensADirectoryOfSeveralFramesAndWindows) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(30'000, 1));
  BlockingClient client = connect(server, {.window_bytes = kMinInitialCredit});
  const auto manifest = client.open("row");
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_GT((*manifest)->directory_bytes, kMaxPayload);
  EXPECT_EQ((*manifest)->directory.real_region_count(), 30'000u);
}

TEST(Loopback, PartsHeldByOthersOutliveTheClient) {
  std::vector<ReceivedPart> held;
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(10));
  {
    BlockingClient client = connect(server);
    const auto manifest = client.open("row").value();
    const auto keep = [&](ReceivedPart part) -> Result<void> {
      held.push_back(std::move(part));
      return {};
    };
    ASSERT_TRUE(client.get({manifest, {.kind = Selection::Kind::All}}, keep));
  }
  EXPECT_EQ(held.size(), 19u);
}

TEST(Loopback, AnErrorOfTheConsumerCancelsTheRest) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(1000, 100'000));
  BlockingClient client = connect(server, {.window_bytes = 1 << 20});
  const auto manifest = client.open("row").value();
  int parts = 0;
  const auto stops = [&](ReceivedPart) -> Result<void> {
    if (++parts == 3) return fail(ErrorCode::Io, "disk full");
    return {};
  };
  const auto stats = client.get({manifest, {.kind = Selection::Kind::All}}, stops);
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().message, "disk full");
  EXPECT_EQ(parts, 3);
  // The connection is fit for more.
  EXPECT_TRUE(client.get({manifest, {.kind = Selection::Kind::Ids, .ids = {7}}}, ignore_part));
}

TEST(Loopback, StopEndsAGetFromAnotherThread) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(1000, 100'000));
  BlockingClient client = connect(server, {.window_bytes = 1 << 20});
  const auto manifest = client.open("row").value();
  std::stop_source source;
  std::jthread stopper;
  const auto stops = [&](ReceivedPart) -> Result<void> {
    if (!stopper.joinable()) stopper = std::jthread([&] { source.request_stop(); });
    return {};
  };
  const auto stats = client.get({manifest, {.kind = Selection::Kind::All}}, stops, source.get_token());
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::Cancelled);
}

TEST(Loopback, SkipsWhatTheClientHas) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(10));
  BlockingClient client = connect(server);
  const auto manifest = client.open("row").value();
  GetRequest request{manifest, {.kind = Selection::Kind::Ids, .ids = {4, 5}}};
  request.have = {manifest->directory.regions[4].levels[0].part.hash};
  const auto stats = client.get(request, ignore_part);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->held, 1u);
  EXPECT_EQ(stats->parts, 2u);  // region 5 and its bundle with 4
}

TEST(Loopback, AReplacedPackKeepsServingWhoOpenedIt) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(10));
  BlockingClient early = connect(server);
  const auto old = early.open("row").value();
  server.folder().put("row.selvage", fake_pack_bytes(12));
  BlockingClient late = connect(server);
  EXPECT_EQ(late.open("row").value()->directory.real_region_count(), 12u);
  EXPECT_TRUE(early.get({old, {.kind = Selection::Kind::All}}, ignore_part));
  // Who opens it again means the new one from then on.
  EXPECT_TRUE(early.open("row"));
  const auto changed = early.get({old, {.kind = Selection::Kind::All}}, ignore_part);
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().code, ErrorCode::ModelChanged);
}

TEST(Loopback, TurnsAwayWhoComesBeyondTheLimit) {
  ServerLimits limits;
  limits.connections = 2;
  TestServer server(limits);
  BlockingClient first = connect(server);
  BlockingClient second = connect(server);
  const auto third = BlockingClient::connect(server.address());
  ASSERT_FALSE(third);
  EXPECT_TRUE(first.ping());
  EXPECT_TRUE(second.ping());
}

TEST(Loopback, ShutdownLetsRequestsFinish) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(400, 50'000));
  BlockingClient client = connect(server, {.window_bytes = 1 << 20});
  const auto manifest = client.open("row").value();
  bool told = false;
  const auto shuts_down = [&](ReceivedPart) -> Result<void> {
    if (!std::exchange(told, true)) server.shut_down();
    return {};
  };
  const auto stats = client.get({manifest, {.kind = Selection::Kind::All}}, shuts_down);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 799u);
  const auto after = client.list();
  ASSERT_FALSE(after);
  EXPECT_EQ(after.error().code, ErrorCode::Unavailable);
}

TEST(Loopback, TheGraceForRequestsInFlightEnds) {
  ServerLimits limits;
  limits.shutdown_grace = std::chrono::milliseconds(20);
  TestServer server(limits);
  server.folder().put("row.selvage", fake_pack_bytes(50, 100'000));
  BlockingClient client = connect(server, {.window_bytes = kMinInitialCredit});
  const auto manifest = client.open("row").value();
  std::vector<ReceivedPart> hoarded;  // so no more is granted, and the request cannot end
  const auto stats =
      client.get({manifest, {.kind = Selection::Kind::All}}, [&](ReceivedPart part) -> Result<void> {
        server.shut_down();
        hoarded.push_back(std::move(part));
        return {};
      });
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::Unavailable);
}

TEST(Loopback, ManyClientsAtOnce) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(100, 3000));
  std::atomic<int> good = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&] {
        BlockingClient client = connect(server);
        const auto manifest = client.open("row").value();
        for (int n = 0; n < 5; ++n) {
          if (client.get({manifest, {.kind = Selection::Kind::All}}, ignore_part)) ++good;
        }
      });
    }
  }
  EXPECT_EQ(good, 40);
}

TEST(Loopback, NobodyListening) {
  HostPort address;
  {
    TestServer server;
    address = server.address();
  }
  const auto client = BlockingClient::connect(address);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, ErrorCode::Unavailable);
}

}  // namespace
}  // namespace selvage
