// SPDX-License-Identifier: MIT
#include "client/load/scripted_client.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include "client/session/client_session.h"
#include "common/net/await.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;

/// What all clients share.
struct Bounds {
  Clock::time_point end;
  std::atomic<std::int64_t> requests_left;

  bool allow() { return Clock::now() < end && requests_left.fetch_sub(1) > 0; }
};

/// One client; everything happens on its strand.
class ScriptedClient {
 public:
  ScriptedClient(const LoadScript& script, const LoadOptions& options, Bounds& bounds, std::uint32_t seed)
      : script_(script), options_(options), bounds_(bounds), random_(seed) {}

  asio::awaitable<void> run() {
    ClientOptions client;
    client.software = "selvage-load";
    client.check_hashes = false;
    const auto begin = Clock::now();
    auto session = co_await ClientSession::connect(options_.server, client);
    if (!session) {
      note(session.error());
      co_return;
    }
    report.latency["connect"].add(Clock::now() - begin);
    session_ = *session;
    for (std::uint32_t round = 0; !script_.rounds || round < *script_.rounds; ++round) {
      if (!co_await run_round()) break;
    }
    session_->close();
  }

  LoadReport report;

 private:
  asio::awaitable<bool> run_round() {
    for (const LoadStep& step : script_.steps) {
      if (step.kind == LoadStep::Kind::Wait) {
        if (!co_await pause(step.pause)) co_return false;
        continue;
      }
      if (!bounds_.allow()) co_return false;
      const auto begin = Clock::now();
      auto outcome = co_await perform(step);
      if (!outcome) {
        note(outcome.error());
        co_return false;
      }
      report.latency[std::string(to_string(step.kind))].add(Clock::now() - begin);
      ++report.requests;
    }
    co_return Clock::now() < bounds_.end;
  }

  asio::awaitable<bool> pause(std::chrono::milliseconds time) {
    asio::steady_timer timer(session_->executor());
    timer.expires_at(std::min(Clock::now() + time, bounds_.end));
    co_await timer.async_wait(kAwait);
    co_return Clock::now() < bounds_.end;
  }

  asio::awaitable<Result<void>> perform(const LoadStep& step) {
    if (step.kind == LoadStep::Kind::List) {
      auto models = co_await session_->list();
      if (!models) co_return forward_error(models);
    } else if (step.kind == LoadStep::Kind::Open) {
      auto manifest = co_await session_->open(step.model);
      if (!manifest) co_return forward_error(manifest);
      manifest_ = *manifest;
    } else {
      auto got = co_await get(step);
      if (!got) co_return forward_error(got);
    }
    co_return Result<void>();
  }

  asio::awaitable<Result<void>> get(const LoadStep& step) {
    GetRequest request{manifest_, step.selection, {}};
    if (step.random_percent) request.selection = random_share(*step.random_percent);
    const auto begin = Clock::now();
    bool is_first = true;
    ClientSession::OnPart on_part = [&](ReceivedPart part) {
      if (std::exchange(is_first, false)) report.first_region.add(Clock::now() - begin);
      report.bytes += part.bytes.size();
      ++report.parts;
    };
    auto stats = co_await session_->get(std::move(request), std::move(on_part));
    if (!stats) co_return forward_error(stats);
    co_return Result<void>();
  }

  /// At least one region.
  Selection random_share(int percent) {
    Selection selection{.kind = Selection::Kind::Ids};
    const std::uint32_t regions = manifest_->directory.real_region_count();
    for (RegionId id = 1; id <= regions; ++id) {
      if (random_() % 100 < static_cast<unsigned>(percent)) selection.ids.push_back(id);
    }
    if (selection.ids.empty() && regions > 0)
      selection.ids.push_back(1 + static_cast<RegionId>(random_() % regions));
    return selection;
  }

  void note(const Error& error) { ++report.errors[std::string(to_string(error.code))]; }

  const LoadScript& script_;
  const LoadOptions& options_;
  Bounds& bounds_;
  std::mt19937 random_;
  std::shared_ptr<ClientSession> session_;
  std::shared_ptr<const Manifest> manifest_;
};

void merge(LoadReport& into, const LoadReport& from) {
  for (const auto& [kind, latency] : from.latency) into.latency[kind].merge(latency);
  into.first_region.merge(from.first_region);
  for (const auto& [code, count] : from.errors) into.errors[code] += count;
  into.requests += from.requests;
  into.parts += from.parts;
  into.bytes += from.bytes;
}

}  // namespace

LoadReport run_load(const LoadScript& script, const LoadOptions& options) {
  const auto begin = Clock::now();
  Bounds bounds{begin + options.duration, static_cast<std::int64_t>(options.max_requests)};
  asio::io_context io;
  std::vector<std::unique_ptr<ScriptedClient>> clients;
  for (std::uint32_t i = 0; i < options.clients; ++i) {
    clients.push_back(std::make_unique<ScriptedClient>(script, options, bounds, i));
    asio::co_spawn(asio::make_strand(io), clients.back()->run(), asio::detached);
  }
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < options.threads; ++i) others.emplace_back([&io] { io.run(); });
    io.run();
  }
  LoadReport report;
  for (const auto& client : clients) merge(report, client->report);
  report.elapsed = Clock::now() - begin;
  return report;
}

}  // namespace selvage
