// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/write.hpp>

#include "tests/support/loopback_proxy.h"

namespace selvage {

/// Stands between a client and a server on loopback and breaks each connection once the server has sent so
/// many bytes over it.
class FlakyProxy : public LoopbackProxy {
 public:
  FlakyProxy(const HostPort& server, std::size_t bytes_a_connection)
      : LoopbackProxy(server), budget_(bytes_a_connection) {
    start();
  }
  ~FlakyProxy() override { stop(); }

  std::uint64_t bytes() const { return bytes_; }  ///< from the server, over all connections
  /// From now on connections last.
  void heal() { budget_ = ~std::size_t{0}; }

 private:
  asio::awaitable<void> pass(tcp::socket& client, tcp::socket& server) override {
    using namespace asio::experimental::awaitable_operators;
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

  std::atomic<std::size_t> budget_;
  std::atomic<std::uint64_t> bytes_ = 0;
};

}  // namespace selvage
