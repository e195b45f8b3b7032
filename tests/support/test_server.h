// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
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
  using MakePublishing = std::function<std::unique_ptr<Publishing>(PackStore&, ServerCounters&)>;

  explicit TestServer(const ServerLimits& limits = {}, AccessTable access = {},
                      std::shared_ptr<TlsContext> tls = nullptr,
                      const MakePublishing& make_publishing = nullptr)
      : access_(std::move(access)),
        publishing_(make_publishing ? make_publishing(*store_, counters_) : nullptr) {
    listener_ = std::move(Listener::bind(io_, {"127.0.0.1", 0}, services_, limits, std::move(tls)).value());
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
  Listener& listener() { return *listener_; }
  AccessControl& access() { return access_; }
  const SessionServices& services() const { return services_; }
  const ServerCounters& counters() const { return counters_; }
  void shut_down() { listener_->shut_down(); }

 private:
  TempFolder folder_;
  std::unique_ptr<PackStore> store_ = std::move(PackStore::open_folder(folder_.path()).value());
  AccessControl access_;
  ServerCounters counters_;
  asio::io_context io_;
  std::unique_ptr<Publishing> publishing_;
  asio::thread_pool workers_{1};
  const SessionServices services_{*store_, workers_.get_executor(), access_, counters_, publishing_.get()};
  std::unique_ptr<Listener> listener_;
  std::vector<std::jthread> threads_;
};

}  // namespace selvage
