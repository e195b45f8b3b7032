// SPDX-License-Identifier: MIT
#pragma once

#include <thread>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>

#include "server/session/listener.h"
#include "tests/support/temp_folder.h"

namespace selvage {

/// A real server on a free loopback port, with threads of its own, over a folder that tests fill.
class TestServer {
 public:
  explicit TestServer(const ServerLimits& limits = {}) {
    listener_ =
        std::move(Listener::bind(io_, {"127.0.0.1", 0}, *store_, workers_.get_executor(), limits).value());
    asio::co_spawn(listener_->executor(), listener_->run(), asio::detached);
    for (int i = 0; i < 2; ++i) threads_.emplace_back([this] { io_.run(); });
  }
  ~TestServer() {
    listener_->shut_down();
    listener_->shut_down();  // no grace
    threads_.clear();
    workers_.join();
  }

  const TempFolder& folder() const { return folder_; }
  HostPort address() const { return listener_->address(); }
  void shut_down() { listener_->shut_down(); }

 private:
  TempFolder folder_;
  std::unique_ptr<PackStore> store_ = std::move(PackStore::open_folder(folder_.path()).value());
  asio::io_context io_;
  asio::thread_pool workers_{1};
  std::unique_ptr<Listener> listener_;
  std::vector<std::jthread> threads_;
};

}  // namespace selvage
