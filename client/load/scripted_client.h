// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>

#include "client/load/load_report.h"
#include "client/load/load_script.h"
#include "client/load/load_stream.h"
#include "client/session/client_session.h"

namespace selvage {

/// Latency by step since it was last taken. Thread-safe.
class LiveLatency {
 public:
  void add(const std::string& label, LatencyHistogram::Duration latency);
  std::map<std::string, LatencyHistogram> take();

 private:
  std::mutex mutex_;
  std::map<std::string, LatencyHistogram> by_label_;
};

/// What the live table shows; written by all clients.
struct LiveCounters {
  LiveLatency latency;
  std::atomic<std::uint32_t> connected = 0;
  std::atomic<std::uint64_t> requests = 0, bytes = 0, errors = 0, latency_us = 0;
};

/// When a test ends, for all clients.
class LoadBounds {
 public:
  using Clock = std::chrono::steady_clock;

  LoadBounds(Clock::time_point end, std::uint64_t max_requests)
      : end_(end.time_since_epoch().count()), requests_left_(static_cast<std::int64_t>(max_requests)) {}

  Clock::time_point end() const { return Clock::time_point(Clock::duration(end_.load())); }
  void end_now() { end_ = Clock::now().time_since_epoch().count(); }
  bool is_over() const { return Clock::now() >= end() || requests_left_ <= 0; }
  /// Counts a request; false if it may not begin any more.
  bool allow() { return Clock::now() < end() && requests_left_.fetch_sub(1) > 0; }

 private:
  std::atomic<Clock::rep> end_;
  std::atomic<std::int64_t> requests_left_;
};

/// What the clients of one network thread share. Used on that thread only, but for what says otherwise.
struct LoadThread {
  asio::io_context& io;
  asio::thread_pool& workers;  ///< decode; thread-safe
  LoadBounds& bounds;          ///< thread-safe
  LiveCounters& live;          ///< thread-safe
  std::map<std::string, KindReport> reports = {};
  // So that thousands of clients hold one of each:
  std::map<Hash, std::shared_ptr<const Manifest>> manifests = {};
  std::map<std::filesystem::path, std::shared_ptr<const std::vector<std::byte>>> files = {};
};

/// One client that does as its kind's script says, over a connection of its own. An error ends its round and
/// is counted; the next round comes after a pause that grows while things go wrong.
class ScriptedClient {
 public:
  ScriptedClient(const ClientKind& kind, ClientOptions options, HostPort server, LoadThread& thread,
                 std::uint32_t number);

  /// `start`: when its first round is to begin.
  asio::awaitable<void> run(LoadBounds::Clock::time_point start);

  const StreamMeter& meter() const { return meter_; }

 private:
  using Clock = LoadBounds::Clock;

  asio::awaitable<bool> run_round(Clock::duration lateness);
  asio::awaitable<Result<void>> connect();
  asio::awaitable<Result<void>> perform(const LoadStep& step);
  asio::awaitable<Result<void>> get(const LoadStep& step);
  asio::awaitable<Result<void>> get_with_drop(const LoadStep& step, GetRequest request,
                                              ClientSession::OnPart on_part);
  asio::awaitable<Result<void>> stall(const LoadStep& step);
  asio::awaitable<Result<void>> publish(const LoadStep& step);
  asio::awaitable<Result<void>> vanish(const LoadStep& step);
  asio::awaitable<bool> sleep_until(Clock::time_point time);
  Selection random_share(const LoadStep& step);
  void disconnect();
  void note(const std::string& label, const Error& error);

  const ClientKind& kind_;
  ClientOptions options_;
  const HostPort server_;
  LoadThread& thread_;
  KindReport& report_;
  const std::uint32_t number_;  ///< of all clients, each has another
  std::mt19937 random_;
  StreamMeter meter_;
  std::shared_ptr<ClientSession> session_;
  std::shared_ptr<const Manifest> manifest_;
};

}  // namespace selvage
