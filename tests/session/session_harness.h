// SPDX-License-Identifier: MIT
//
// Server sessions in memory, on the test's own thread: nothing sleeps, nothing listens.
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>

#include "client/session/client_session.h"
#include "server/session/session.h"
#include "tests/support/fake_pack.h"
#include "tests/support/memory_stream.h"
#include "tests/support/raw_peer.h"
#include "tests/support/temp_folder.h"

namespace selvage::testing {

class SessionHarness {
 public:
  explicit SessionHarness(const SessionLimits& limits = {}, MemoryStreamOptions options = {})
      : limits_(limits), options_(std::move(options)) {}

  const TempFolder& folder() const { return folder_; }
  asio::any_io_executor executor() { return io_.get_executor(); }

  /// The other end of a connection whose near end a session serves (start it before run()).
  std::unique_ptr<ByteStream> connect() {
    auto [near_end, far_end] = make_memory_streams(executor(), options_);
    sessions_.push_back(std::make_unique<Session>(std::move(near_end), services_, limits_));
    asio::co_spawn(executor(), session().run(), [this](std::exception_ptr thrown) {
      ++sessions_ended_;
      if (thrown) thrown_ = thrown;
    });
    return std::move(far_end);
  }

  /// Runs `work` and whatever it leads to. Throws what any coroutine throws, and when something still waits
  /// after a time that no test should need.
  void run(asio::awaitable<void> work) {
    bool done = false;
    asio::co_spawn(executor(), std::move(work), [&](std::exception_ptr thrown) {
      done = true;
      if (thrown) thrown_ = thrown;
    });
    io_.run_for(std::chrono::seconds(60));
    if (thrown_) std::rethrow_exception(thrown_);
    if (!done) throw std::runtime_error("the test's coroutine waits forever");
    if (sessions_ended_ < sessions_.size()) throw std::runtime_error("the server's session does not end");
  }

  Session& session() { return *sessions_.back(); }  ///< of the last connection
  AccessControl& access() { return access_; }

 private:
  const SessionLimits limits_;
  const MemoryStreamOptions options_;
  TempFolder folder_;
  std::unique_ptr<PackStore> store_ = std::move(PackStore::open_folder(folder_.path()).value());
  asio::io_context io_;
  AccessControl access_;
  ServerCounters counters_;
  const SessionServices services_{*store_, io_.get_executor(), access_, counters_};
  std::vector<std::unique_ptr<Session>> sessions_;
  std::size_t sessions_ended_ = 0;
  std::exception_ptr thrown_;
};

}  // namespace selvage::testing
