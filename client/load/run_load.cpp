// SPDX-License-Identifier: MIT
#include "client/load/run_load.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include "client/load/scripted_client.h"

namespace selvage {
namespace {

using Clock = LoadBounds::Clock;

/// Thousands of clients share a machine, and those that keep no parts need no large window.
constexpr std::uint64_t kWindowBytes = 1u << 20;
constexpr std::size_t kReadBytes = 32u << 10;

/// A network thread with its clients.
struct Crew {
  Crew(asio::thread_pool& workers, LoadBounds& bounds, LiveCounters& live)
      : thread{io, workers, bounds, live} {}

  std::vector<std::unique_ptr<ScriptedClient>> clients;  // before io: its coroutines use them to the last
  asio::io_context io{1};
  LoadThread thread;
};

void hire(std::vector<std::unique_ptr<Crew>>& crews, const LoadScript& script, const LoadOptions& options) {
  std::uint32_t total = 0, index = 0;
  for (const ClientKind& kind : script.kinds) total += kind.count;
  ClientOptions connection = options.connection;
  connection.software = "selvage-load";
  connection.window_bytes = kWindowBytes;
  connection.read_bytes = kReadBytes;
  const auto begin = Clock::now();
  // Kinds take turns, so that a ramp brings some of each from the start.
  std::uint32_t most = 0;
  for (const ClientKind& kind : script.kinds) most = std::max(most, kind.count);
  for (std::uint32_t round = 0; round < most; ++round) {
    for (const ClientKind& kind : script.kinds) {
      // Evenly: of fewer clients, one comes every so many rounds.
      const std::uint64_t before = std::uint64_t{round} * kind.count / most;
      if (std::uint64_t{round + 1} * kind.count / most == before) continue;
      Crew& crew = *crews[index % crews.size()];
      crew.clients.push_back(
          std::make_unique<ScriptedClient>(kind, connection, options.server, crew.thread, index));
      const auto start = begin + script.ramp * index / std::max(total, 1u);
      asio::co_spawn(crew.io, crew.clients.back()->run(start), asio::detached);
      ++index;
    }
  }
}

/// Turns counters into samples, a moment after the other.
class Sampler {
 public:
  Sampler(LiveCounters& live, Clock::time_point begin) : live_(live), begin_(begin), last_(begin) {}

  LoadSample take() {
    const auto now = Clock::now();
    const double seconds = std::max(std::chrono::duration<double>(now - last_).count(), 1e-6);
    const Counts counts = read();
    LoadSample sample;
    sample.seconds = std::chrono::duration<double>(now - begin_).count();
    sample.clients = live_.connected;
    const auto requests = static_cast<double>(counts.requests - counts_.requests);
    sample.requests_per_second = requests / seconds;
    sample.bytes_per_second = static_cast<double>(counts.bytes - counts_.bytes) / seconds;
    sample.errors_per_second = static_cast<double>(counts.errors - counts_.errors) / seconds;
    if (requests > 0)
      sample.mean_latency_ms = static_cast<double>(counts.latency_us - counts_.latency_us) / 1e3 / requests;
    for (const auto& [label, latency] : live_.latency.take()) {
      sample.steps.push_back({label, latency.count(), latency.percentile(0.5), latency.percentile(0.9),
                              latency.percentile(0.99), latency.max()});
    }
    last_ = now;
    counts_ = counts;
    return sample;
  }

 private:
  struct Counts {
    std::uint64_t requests = 0, bytes = 0, errors = 0, latency_us = 0;
  };
  Counts read() const { return {live_.requests, live_.bytes, live_.errors, live_.latency_us}; }

  LiveCounters& live_;
  const Clock::time_point begin_;
  Clock::time_point last_;
  Counts counts_;
};

}  // namespace

LoadReport run_load(const LoadScript& script, const LoadOptions& options, std::stop_token stop) {
  const auto begin = Clock::now();
  LoadBounds bounds(begin + script.duration.value_or(options.duration), options.max_requests);
  LiveCounters live;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  asio::thread_pool workers(options.decode_threads > 0 ? options.decode_threads : cores);
  std::vector<std::unique_ptr<Crew>> crews;
  for (unsigned i = 0; i < std::max(1u, options.threads); ++i)
    crews.push_back(std::make_unique<Crew>(workers, bounds, live));
  hire(crews, script, options);

  LoadReport report;
  std::mutex mutex;
  std::condition_variable_any changed;
  std::size_t running = crews.size();
  {
    std::vector<std::jthread> threads;
    for (const auto& crew : crews) {
      threads.emplace_back([&, &io = crew->io] {
        io.run();
        const std::scoped_lock lock(mutex);
        --running;
        changed.notify_all();
      });
    }
    Sampler sampler(live, begin);
    std::unique_lock lock(mutex);
    bool is_told = false;
    while (running > 0) {
      changed.wait_for(lock, stop, options.sample_every, [&] { return running == 0; });
      if (stop.stop_requested() && !std::exchange(is_told, true)) {
        bounds.end_now();
        stop = {};  // or there would be no waiting any more
      }
      report.samples.push_back(sampler.take());
      if (options.on_sample) options.on_sample(report.samples.back());
      if (running > 0 && Clock::now() > bounds.end() + options.grace) {
        for (const auto& crew : crews) crew->io.stop();
      }
    }
  }
  workers.join();
  report.elapsed = Clock::now() - begin;
  report.is_corrected =
      std::ranges::all_of(script.kinds, [](const ClientKind& kind) { return kind.every.has_value(); });
  for (const ClientKind& kind : script.kinds) report.kinds[kind.name];
  for (const auto& crew : crews) {
    for (const auto& [name, kind] : crew->thread.reports) report.kinds[name].merge(kind);
  }
  return report;
}

}  // namespace selvage
