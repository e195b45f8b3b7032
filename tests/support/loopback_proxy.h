// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <thread>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/net/await.h"
#include "common/net/tcp_stream.h"

namespace selvage {

/// Stands between a client and a server on loopback, on a thread of its own. What it does to the bytes, those
/// that derive from it say.
class LoopbackProxy {
 public:
  HostPort address() const { return {"127.0.0.1", acceptor_.local_endpoint().port()}; }
  int connections() const { return connections_; }

 protected:
  using tcp = boost::asio::ip::tcp;

  explicit LoopbackProxy(const HostPort& server)
      : server_(boost::asio::ip::make_address(server.host), server.port) {}
  virtual ~LoopbackProxy() = default;

  /// To be called last by the constructor of the derived class, and stop() first by its destructor.
  void start() {
    boost::asio::co_spawn(io_, accept(), boost::asio::detached);
    thread_ = std::jthread([this] { io_.run(); });
  }
  void stop() {
    io_.stop();
    thread_.join();
  }

  /// Passes the bytes of one connection; it ends when this returns.
  virtual boost::asio::awaitable<void> pass(tcp::socket& client, tcp::socket& server) = 0;

 private:
  boost::asio::awaitable<void> accept() {
    for (;;) {
      auto [error, client] = co_await acceptor_.async_accept(kAwait);
      if (error) co_return;
      ++connections_;
      boost::asio::co_spawn(io_, serve(std::move(client)), boost::asio::detached);
    }
  }

  boost::asio::awaitable<void> serve(tcp::socket client) {
    tcp::socket server(io_);
    auto [error] = co_await server.async_connect(server_, kAwait);
    if (!error) co_await pass(client, server);
  }

  boost::asio::io_context io_;
  tcp::acceptor acceptor_{io_, tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), 0)};
  tcp::endpoint server_;
  std::atomic<int> connections_ = 0;
  std::jthread thread_;
};

}  // namespace selvage
