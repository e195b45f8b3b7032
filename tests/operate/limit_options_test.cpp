// SPDX-License-Identifier: MIT
//
// That the server's options for limits set those limits. What happens beyond each is the matter of
// session_test and publish_test; here it need only happen.
#include <future>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/use_future.hpp>

#include "client/session/blocking_client.h"
#include "tests/operate/process_fixture.h"
#include "tests/support/fake_pack.h"
#include "tests/support/raw_peer.h"

namespace selvage {
namespace {

using testing::quoted;
using testing::RawPeer;
using testing::run_program;

/// A peer without manners for tests that are no coroutines.
class Peer {
 public:
  explicit Peer(const HostPort& server)
      : peer_(std::move(wait_for(connect_tcp(server.host, server.port, std::chrono::seconds(10))).value())) {}

  template <class Message>
  void send(Message message, std::uint32_t request_id = 0) {
    wait_for(peer_.send(std::move(message), request_id));
  }
  RawPeer::Received receive() {
    auto frame = wait_for(peer_.receive_control());
    if (!frame) throw std::runtime_error("the connection has ended");
    return std::move(*frame);
  }
  HelloAck greet() {
    Hello hello;
    hello.initial_credit = 1 << 20;
    send(std::move(hello));
    return receive().as<HelloAck>();
  }
  /// What the server has against it.
  ErrorCode refusal() {
    for (;;) {
      const auto frame = receive();
      if (frame.is(FrameType::Error)) return frame.as<ErrorMessage>().error.code;
    }
  }

 private:
  template <class T>
  T wait_for(asio::awaitable<T> work) {
    std::future<T> done = asio::co_spawn(io_, std::move(work), asio::use_future);
    io_.restart();
    io_.run();
    return done.get();
  }

  asio::io_context io_;
  RawPeer peer_;
};

class LimitOptions : public ProcessFixture {
 protected:
  LimitOptions() { replace("row", 10); }

  /// A model of so many regions, and as many bundles less one.
  void replace(const std::string& name, std::uint32_t regions) const {
    const auto bytes = fake_pack_bytes(regions, 100'000);
    std::ofstream(folder.path() / "new", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::filesystem::rename(folder.path() / "new", store() / (name + ".selvage"));
  }
};

TEST_F(LimitOptions, ThoseThatClientsMustKnowAreToldToThem) {
  const auto server = start_on_store(
      {"--max-requests", "3", "--max-ids", "5", "--max-message", "200KiB", "--idle-timeout", "7.5"});
  const HelloAck told = Peer(server->address()).greet();
  EXPECT_EQ(told.max_requests, 3u);
  EXPECT_EQ(told.max_ids, 5u);
  EXPECT_EQ(told.max_message_bytes, 200u << 10);
  EXPECT_EQ(told.idle_timeout_ms, 7500u);
}

TEST_F(LimitOptions, ConnectionsFromOneAddress) {
  const auto server = start_on_store({"--max-connections-per-address", "1"});
  Peer first(server->address());
  first.greet();
  EXPECT_EQ(Peer(server->address()).refusal(), ErrorCode::Unavailable);
}

TEST_F(LimitOptions, TimeToSayHello) {
  const auto server = start_on_store({"--handshake-timeout", "0.05"});
  EXPECT_EQ(Peer(server->address()).refusal(), ErrorCode::Timeout);
}

TEST_F(LimitOptions, Silence) {
  const auto server = start_on_store({"--idle-timeout", "0.05"});
  Peer peer(server->address());
  peer.greet();
  EXPECT_EQ(peer.refusal(), ErrorCode::Timeout);
}

TEST_F(LimitOptions, TimeForAWrite) {
  const auto server = start_on_store({"--write-timeout", "0.05"});
  replace("row", 200);
  Peer reads_nothing(server->address());
  Hello hello;
  hello.initial_credit = 1 << 30;
  reads_nothing.send(std::move(hello));
  GetParts get;
  get.model = "row";
  reads_nothing.send(std::move(get), 1);
  auto observer = BlockingClient::connect(server->address()).value();
  while (observer.status().value().requests < 1) std::this_thread::yield();
  while (observer.status().value().connections > 1) std::this_thread::yield();
}

TEST_F(LimitOptions, PartsQueued) {
  const auto server = start_on_store({"--max-queued-parts", "3"});
  Peer peer(server->address());
  peer.greet();
  GetParts get;
  get.model = "row";
  peer.send(std::move(get), 1);
  EXPECT_EQ(peer.refusal(), ErrorCode::LimitExceeded);
}

TEST_F(LimitOptions, ModelsOpened) {
  const auto server = start_on_store({"--max-opened-models", "1"});
  replace("other", 10);
  auto client = BlockingClient::connect(server->address()).value();
  const auto row = client.open("row").value();
  ASSERT_TRUE(client.open("other"));
  replace("row", 11);
  const auto got =
      client.get({row, {.kind = Selection::Kind::All}}, [](ReceivedPart) { return Result<void>(); });
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, ErrorCode::ModelChanged);
}

TEST_F(LimitOptions, Uploads) {
  const std::string tokens = file("tokens", kModeller), mesh = file("mesh.obj", std::string(3000, '#'));
  const auto publish = [&](const std::vector<std::string>& options) {
    auto arguments = options;
    arguments.insert(arguments.end(), {"--tokens", tokens});
    const auto server = start_on_store(arguments);
    return run_program(quoted(SELVAGE_CLIENT) + " publish " + server->address().to_string() + ' ' +
                       quoted(mesh) + " --token hunter2 --retry-for 0")
        .text;
  };
  const std::string large = publish({"--max-upload", "2KiB"});
  EXPECT_NE(large.find("larger than the 2048 bytes"), std::string::npos) << large;
  const std::string full = publish({"--max-staged", "2KiB"});
  EXPECT_NE(full.find("no room for more uploads"), std::string::npos) << full;
}

}  // namespace
}  // namespace selvage
