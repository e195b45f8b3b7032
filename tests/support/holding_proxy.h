// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/write.hpp>

#include "common/net/frame.h"
#include "common/net/signal.h"
#include "tests/support/loopback_proxy.h"

namespace selvage {

/// Stands between a client and a server on loopback, and holds back whatever the server says until the client
/// has sent a frame of some type. A client that waits for an answer before that waits in vain: so it counts
/// flights, not time.
class HoldingProxy : public LoopbackProxy {
 public:
  HoldingProxy(const HostPort& server, FrameType until) : LoopbackProxy(server), until_(until) { start(); }
  ~HoldingProxy() override { stop(); }

  /// Of frames of that type, over all connections.
  int sent(FrameType type) const { return sent_[static_cast<std::size_t>(type)]; }

 private:
  asio::awaitable<void> pass(tcp::socket& client, tcp::socket& server) override {
    using namespace asio::experimental::awaitable_operators;
    Signal released;
    auto there = pass_requests(client, server, released);
    auto back = pass_answers(server, client, released);
    co_await (std::move(there) || std::move(back));
  }

  asio::awaitable<void> pass_requests(tcp::socket& from, tcp::socket& to, Signal& released) {
    std::vector<std::byte> buffer(4096), waiting;
    for (;;) {
      auto [error, count] = co_await from.async_read_some(asio::buffer(buffer), kAwait);
      if (error) co_return;
      waiting.insert(waiting.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
      while (waiting.size() >= kFrameHeaderSize) {
        const auto header = parse_header(std::span(waiting).first<kFrameHeaderSize>());
        const std::size_t size = kFrameHeaderSize + header.value().length;
        if (waiting.size() < size) break;
        ++sent_[static_cast<std::size_t>(header->type)];
        if (header->type == until_) released.notify();
        waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(size));
      }
      auto [broken, written] = co_await asio::async_write(to, asio::buffer(buffer.data(), count), kAwait);
      if (broken) co_return;
    }
  }

  asio::awaitable<void> pass_answers(tcp::socket& from, tcp::socket& to, Signal& released) {
    co_await released.wait();
    std::vector<std::byte> buffer(4096);
    for (;;) {
      auto [error, count] = co_await from.async_read_some(asio::buffer(buffer), kAwait);
      if (error) co_return;
      auto [broken, written] = co_await asio::async_write(to, asio::buffer(buffer.data(), count), kAwait);
      if (broken) co_return;
    }
  }

  const FrameType until_;
  std::array<std::atomic<int>, 256> sent_{};
};

}  // namespace selvage
