// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <thread>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include "common/net/await.h"
#include "common/net/tcp_stream.h"

namespace selvage {

/// Stands between a client and a server on loopback and breaks each connection once the server has sent so
/// many bytes over it.
class FlakyProxy {
 public:
  FlakyProxy(const HostPort& server, std::size_t bytes_a_connection)
      : server_(asio::ip::make_address(server.host), server.port), budget_(bytes_a_connection) {
    asio::co_spawn(io_, accept(), asio::detached);
    thread_ = std::jthread([this] { io_.run(); });
  }
  ~FlakyProxy() { io_.stop(); }

  HostPort address() const { return {"127.0.0.1", acceptor_.local_endpoint().port()}; }
  int connections() const { return connections_; }
  std::uint64_t bytes() const { return bytes_; }  ///< from the server, over all connections
  /// From now on connections last.
  void heal() { budget_ = ~std::size_t{0}; }

 private:
  using tcp = asio::ip::tcp;

  asio::awaitable<void> accept() {
    for (;;) {
      auto [error, client] = co_await acceptor_.async_accept(kAwait);
      if (error) co_return;
      ++connections_;
      asio::co_spawn(io_, serve(std::move(client)), asio::detached);
    }
  }

  asio::awaitable<void> serve(tcp::socket client) {
    using namespace asio::experimental::awaitable_operators;
    tcp::socket server(io_);
    auto [error] = co_await server.async_connect(server_, kAwait);
    if (error) co_return;
    auto there = pump(client, server, nullptr);
    auto back = pump(server, client, &bytes_);
    co_await (std::move(there) || std::move(back));
  }

  asio::awaitable<void> pump(tcp::socket& from, tcp::socket& to, std::atomic<std::uint64_t>* counted) {
    std::vector<std::byte> buffer(4096);
    for (std::size_t passed = 0; counted == nullptr || passed < budget_;) {
      auto [error, count] = co_await from.async_read_some(asio::buffer(buffer), kAwait);
      if (error) co_return;
      auto [broken, written] = co_await asio::async_write(to, asio::buffer(buffer.data(), count), kAwait);
      if (broken) co_return;
      passed += count;
      if (counted != nullptr) *counted += count;
    }
  }

  asio::io_context io_;
  tcp::acceptor acceptor_{io_, tcp::endpoint(asio::ip::make_address("127.0.0.1"), 0)};
  tcp::endpoint server_;
  std::atomic<std::size_t> budget_;
  std::atomic<int> connections_ = 0;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::jthread thread_;
};

}  // namespace selvage
