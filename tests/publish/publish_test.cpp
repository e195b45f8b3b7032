// SPDX-License-Identifier: MIT
//
// Publishing over real connections.
#include <gtest/gtest.h>

#include <boost/asio/use_future.hpp>

#include "client/session/blocking_client.h"
#include "common/base/hash.h"
#include "common/mesh/same_mesh.h"
#include "common/mesh_io/read_mesh.h"
#include "server/publish/publisher.h"
#include "tests/support/mesh_text.h"
#include "tests/support/raw_peer.h"
#include "tests/support/shapes.h"
#include "tests/support/test_server.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

/// printf %s secret | sha256sum; and of "hunter2".
const std::string kTokens =
    "viewer read sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b\n"
    "modeller read,publish sha256:f52fbd32b2b3b86ff88ef6c490628285f482af15ddcb29541f94bcf526a3f6c7\n";

constexpr auto ignore_state = [](const PublishState&) {};
constexpr auto ignore_part = [](ReceivedPart) { return Result<void>(); };

/// A mesh file in memory that knows how much of it was asked for.
struct TextFile {
  std::string text, name;
  std::uint64_t read_bytes = 0;

  PublishRequest request(const std::string& model, bool replace = false) {
    PublishRequest request;
    request.what.name = model;
    request.what.file = name;
    request.what.size_bytes = text.size();
    request.what.hash = hash_of(std::as_bytes(std::span(text)));
    request.what.replace = replace;
    request.read = [this](std::uint64_t offset, std::span<std::byte> into) -> Result<std::size_t> {
      const auto rest = std::as_bytes(std::span(text)).subspan(offset);
      const auto count = std::min(rest.size(), into.size());
      std::ranges::copy(rest.first(count), into.begin());
      read_bytes += count;
      return count;
    };
    return request;
  }
};

class Publishes : public ::testing::Test {
 protected:
  static TestServer::MakePublishing publishing(const PublishLimits& limits) {
    return [limits](PackStore& store, ServerCounters& counters) {
      return std::make_unique<Publisher>(store, counters, limits);
    };
  }
  BlockingClient connect(const std::string& token = "hunter2") const {
    ClientOptions options;
    options.token = token;
    auto client = BlockingClient::connect(server.address(), options);
    if (!client) throw std::runtime_error(client.error().message);
    return std::move(*client);
  }

  TestServer server{{}, AccessTable::parse(kTokens).value(), nullptr, publishing({})};
  TextFile torus{obj_text(shapes::torus(110, 130)), "torus.obj"};
};

TEST_F(Publishes, AMeshOfManyFramesComesBackAsItWas) {
  ASSERT_GT(torus.text.size(), 3 * kMaxDataPayload);
  BlockingClient client = connect();
  std::vector<std::string> stages;
  const auto note = [&](const PublishState& state) {
    if (stages.empty() || stages.back() != state.server.stage) stages.push_back(state.server.stage);
  };
  const auto published = client.publish(torus.request("ring"), note);
  ASSERT_TRUE(published) << published.error().message;
  EXPECT_EQ(published->triangles, 28600u);
  EXPECT_EQ(torus.read_bytes, torus.text.size());
  for (const char* stage : {"", "wait", "check", "encode"}) {
    EXPECT_NE(std::ranges::find(stages, stage), stages.end()) << stage;
  }
  const auto models = client.list().value();
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0].pack_id, published->pack_id);

  const auto pack = Pack::open(server.folder().path() / "ring.selvage").value();
  const auto mesh = unpack(*pack).value();
  EXPECT_TRUE(compare_meshes(shapes::torus(110, 130), mesh.soup, pack->directory().grid.step * 0.51).same);
}

TEST_F(Publishes, NeedsTheScope) {
  BlockingClient viewer = connect("secret");
  const auto refused = viewer.publish(torus.request("ring"), ignore_state);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::Unauthorised);
  EXPECT_NE(refused.error().message.find("'publish'"), std::string::npos) << refused.error().message;
  EXPECT_EQ(viewer.unpublish("ring").error().code, ErrorCode::Unauthorised);
  EXPECT_EQ(torus.read_bytes, 0u);
}

TEST_F(Publishes, ABadFileGivesTheErrorThatSelvagePackGives) {
  const TempFolder folder;
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 nonsense\nf 1 2 3\n";
  folder.put("bad.obj", std::as_bytes(std::span(text)));
  const auto path = folder.path() / "bad.obj";
  std::string expected = read_mesh(path).error().message;
  expected.replace(0, path.string().size(), "bad.obj");
  TextFile bad{text, "bad.obj"};
  const auto refused = connect().publish(bad.request("bad"), ignore_state);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::BadFile);
  EXPECT_EQ(refused.error().message, expected);
}

TEST_F(Publishes, WhatRepairDidIsReported) {
  TextFile dirty{"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 1 2\n", "dirty.obj"};
  const auto published = connect().publish(dirty.request("dirty"), ignore_state);
  ASSERT_TRUE(published) << published.error().message;
  EXPECT_GE(published->notes.size(), 2u);
}

TEST_F(Publishes, ReplacingLeavesRunningReadersAlone) {
  BlockingClient client = connect();
  ASSERT_TRUE(client.publish(torus.request("ring"), ignore_state));
  BlockingClient reader = connect("secret");
  const auto old = reader.open("ring").value();
  TextFile other{obj_text(shapes::sphere(4)), "sphere.obj"};
  EXPECT_FALSE(client.publish(other.request("ring"), ignore_state));
  const auto replaced = client.publish(other.request("ring", true), ignore_state);
  ASSERT_TRUE(replaced) << replaced.error().message;
  EXPECT_TRUE(reader.get({old, {.kind = Selection::Kind::All}}, ignore_part));
  EXPECT_EQ(reader.open("ring").value()->pack_id, replaced->pack_id);
  ASSERT_TRUE(client.unpublish("ring"));
  EXPECT_TRUE(client.list()->empty());
  EXPECT_EQ(client.unpublish("ring").error().code, ErrorCode::NotFound);
}

TEST_F(Publishes, StopDuringTheUploadLeavesNothingBehind) {
  BlockingClient client = connect();
  std::stop_source source;
  const auto stops = [&](const PublishState& state) {
    if (state.sent_bytes > 0) source.request_stop();
  };
  const auto stopped = client.publish(torus.request("ring"), stops, source.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
  EXPECT_TRUE(client.ping()) << "the connection is fit for more";
  EXPECT_TRUE(client.publish(torus.request("ring"), ignore_state));
}

TEST_F(Publishes, AnErrorOfTheFileEndsIt) {
  BlockingClient client = connect();
  PublishRequest request = torus.request("ring");
  request.read = [](std::uint64_t, std::span<std::byte>) { return Result<std::size_t>(0); };
  const auto failed = client.publish(std::move(request), ignore_state);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::Io);
}

/// Greets, and begins an upload; gives the connection, which has sent a first frame of Data.
asio::awaitable<std::unique_ptr<testing::RawPeer>> begin_upload(HostPort address, Publish what,
                                                                std::string text, std::size_t first_bytes) {
  auto stream = co_await connect_tcp(address.host, address.port, std::chrono::seconds(10));
  auto peer = std::make_unique<testing::RawPeer>(std::move(*stream));
  Hello hello;
  hello.token = "hunter2";
  co_await peer->send(hello);
  co_await peer->send(what, 1);
  co_await peer->receive();  // HelloAck
  const auto ready = co_await peer->receive();
  if (!ready || !ready->is(FrameType::PublishReady)) throw std::runtime_error("no PublishReady");
  const auto bytes = std::as_bytes(std::span(text)).first(first_bytes);
  std::vector<std::byte> data(bytes.begin(), bytes.end());
  co_await peer->send_data(1, 0, std::move(data), false);
  Ping ping;
  co_await peer->send(ping, 2);
  const auto pong = co_await peer->receive();  // so the Data before it is on the disk
  if (!pong || !pong->is(FrameType::Pong)) throw std::runtime_error("no Pong");
  co_return peer;
}

TEST_F(Publishes, GoesOnWhereALostConnectionEnded) {
  asio::io_context io;
  auto begun = asio::co_spawn(
      io, begin_upload(server.address(), torus.request("ring").what, torus.text, 50'000), asio::use_future);
  io.run();
  begun.get()->close();
  const auto published = connect().publish(torus.request("ring"), ignore_state);
  ASSERT_TRUE(published) << published.error().message;
  EXPECT_EQ(torus.read_bytes, torus.text.size() - 50'000);
}

TEST_F(Publishes, OneUploadAtATimeOnAConnection) {
  asio::io_context io;
  const Publish what = torus.request("ring").what, other = torus.request("other").what;
  auto second = [&]() -> asio::awaitable<ErrorMessage> {
    auto peer = co_await begin_upload(server.address(), what, torus.text, 100);
    co_await peer->send(other, 5);
    const auto answer = co_await peer->receive();
    co_return answer->as<ErrorMessage>();
  };
  auto answer = asio::co_spawn(io, second(), asio::use_future);
  io.run();
  EXPECT_EQ(answer.get().error.code, ErrorCode::LimitExceeded);
}

TEST_F(Publishes, DataBeyondTheEndEndsTheUploadOnly) {
  asio::io_context io;
  TextFile small{"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "small.obj"};
  const Publish what = small.request("small").what;
  auto overflow = [&]() -> asio::awaitable<ErrorMessage> {
    auto peer = co_await begin_upload(server.address(), what, small.text, 5);
    std::vector<std::byte> data(100);
    co_await peer->send_data(1, 0, std::move(data), false);
    const auto answer = co_await peer->receive();
    Ping ping;
    co_await peer->send(ping, 3);
    const auto pong = co_await peer->receive();
    EXPECT_TRUE(pong && pong->is(FrameType::Pong));
    co_return answer->as<ErrorMessage>();
  };
  auto answer = asio::co_spawn(io, overflow(), asio::use_future);
  io.run();
  EXPECT_EQ(answer.get().error.code, ErrorCode::InvalidArgument);
}

TEST_F(Publishes, StatusTellsOfModelsAndUploads) {
  server.folder().put("torn.selvage", std::vector<std::byte>(10));
  BlockingClient client = connect();
  ASSERT_TRUE(client.publish(torus.request("ring"), ignore_state));
  ASSERT_TRUE(client.list());
  const auto status = client.status();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(status->models, 2u);
  ASSERT_EQ(status->problems.size(), 1u);
  EXPECT_EQ(status->problems[0].name, "torn");
  EXPECT_EQ(status->published, 1u);
  EXPECT_EQ(status->bytes_uploaded, torus.text.size());
  EXPECT_EQ(status->connections, 1u);
  EXPECT_GE(status->requests, 3u);
}

TEST(PublishLess, AServerWithoutPublishingSaysSo) {
  TestServer server({}, AccessTable::parse(kTokens).value());
  ClientOptions options;
  options.token = "hunter2";
  auto client = BlockingClient::connect(server.address(), options).value();
  TextFile file{"v 0 0 0\n", "a.obj"};
  EXPECT_EQ(client.publish(file.request("a"), ignore_state).error().code, ErrorCode::Unsupported);
  EXPECT_EQ(client.unpublish("a").error().code, ErrorCode::Unsupported);
}

}  // namespace
}  // namespace selvage
