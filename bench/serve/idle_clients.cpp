// SPDX-License-Identifier: MIT
#include "bench/serve/idle_clients.h"

#include <exception>
#include <stdexcept>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>

#include "tests/support/raw_peer.h"

namespace selvage::bench {
namespace {

using testing::RawPeer;

/// The first so many bring what is there once: they are not counted.
constexpr unsigned kFirst = 100;

asio::awaitable<void> expect(RawPeer& peer, FrameType type) {
  const auto frame = co_await peer.receive();
  if (!frame || !frame->is(type)) throw std::runtime_error("the server does not answer as it should");
}

asio::awaitable<void> hold(const Process& server, Destination to, IdleCost& cost) {
  const Hello hello;
  const Ping ping;
  std::vector<std::unique_ptr<RawPeer>> peers;
  std::uint64_t before = 0;
  for (unsigned i = 0; i < cost.connections + kFirst; ++i) {
    if (i == kFirst) before = server.anonymous_bytes();
    std::unique_ptr<ByteStream> stream = co_await connect(to);
    const Result<void> ready = co_await stream->handshake();
    if (!ready) throw std::runtime_error(ready.error().message);
    peers.push_back(std::make_unique<RawPeer>(std::move(stream)));
    co_await peers.back()->send(hello);
    co_await expect(*peers.back(), FrameType::HelloAck);
  }
  cost.bytes_each = static_cast<double>(server.anonymous_bytes() - before) / cost.connections;
  for (unsigned i = kFirst; i < peers.size(); ++i) {
    co_await peers[i]->send(ping, 7);
    co_await expect(*peers[i], FrameType::Pong);
    ++cost.answered;
  }
}

}  // namespace

IdleCost hold_idle(const Process& server, const Destination& to, unsigned connections) {
  asio::io_context io;
  IdleCost cost;
  cost.connections = connections;
  std::exception_ptr thrown;
  asio::co_spawn(io, hold(server, to, cost), [&](std::exception_ptr exception) { thrown = exception; });
  io.run();
  if (thrown) std::rethrow_exception(thrown);
  return cost;
}

}  // namespace selvage::bench
