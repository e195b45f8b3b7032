// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/write.hpp>

#include "common/net/signal.h"
#include "tests/support/loopback_proxy.h"

namespace selvage {

/// Stands between a client and a server on loopback and passes so many bytes from either side; then it falls
/// silent, as a link that is gone without a word, until it is opened.
class GatedProxy : public LoopbackProxy {
 public:
  struct Bytes {
    std::size_t from_client, from_server;
  };
  static constexpr std::size_t kAll = ~std::size_t{0};

  GatedProxy(const HostPort& server, Bytes before) : LoopbackProxy(server), before_(before) { start(); }
  ~GatedProxy() override { stop(); }

  void wait_until_silent() const { is_silent_.wait(false); }
  void open() { is_open_ = true; }

 private:
  asio::awaitable<void> pass(tcp::socket& client, tcp::socket& server) override {
    using namespace asio::experimental::awaitable_operators;
    auto there = pump(client, server, before_.from_client);
    auto back = pump(server, client, before_.from_server);
    co_await (std::move(there) || std::move(back));
  }

  asio::awaitable<void> pump(tcp::socket& from, tcp::socket& to, std::size_t left) {
    std::vector<std::byte> buffer(4096);
    for (;;) {
      while (left == 0) co_await wait_for_gate(left);
      auto [error, count] =
          co_await from.async_read_some(asio::buffer(buffer.data(), std::min(left, buffer.size())), kAwait);
      if (error) co_return;
      auto [broken, written] = co_await asio::async_write(to, asio::buffer(buffer.data(), count), kAwait);
      if (broken) co_return;
      if (left != kAll) left -= count;
    }
  }

  asio::awaitable<void> wait_for_gate(std::size_t& left) {
    is_silent_ = true;
    is_silent_.notify_all();
    Signal nothing;
    co_await nothing.wait_for(std::chrono::milliseconds(10));
    if (is_open_) left = kAll;
  }

  const Bytes before_;
  std::atomic<bool> is_silent_ = false, is_open_ = false;
};

}  // namespace selvage
