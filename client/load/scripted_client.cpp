// SPDX-License-Identifier: MIT
#include "client/load/scripted_client.h"

#include <algorithm>
#include <fstream>

#include <boost/asio/steady_timer.hpp>

#include "client/fetch/missing_parts.h"
#include "client/load/decode_check.h"
#include "client/load/send_garbage.h"
#include "common/net/await.h"

namespace selvage {
namespace {

constexpr std::chrono::milliseconds kFirstPause{200}, kLongestPause{5000};

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<std::byte> bytes(file ? static_cast<std::size_t>(file.tellg()) : 0);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file || bytes.empty()) return fail(ErrorCode::Io, path.string() + ": cannot be read");
  return bytes;
}

}  // namespace

void LiveLatency::add(const std::string& label, LatencyHistogram::Duration latency) {
  const std::scoped_lock lock(mutex_);
  by_label_[label].add(latency);
}

std::map<std::string, LatencyHistogram> LiveLatency::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(by_label_, {});
}

ScriptedClient::ScriptedClient(const ClientKind& kind, ClientOptions options, HostPort server,
                               LoadThread& thread, std::uint32_t number)
    : kind_(kind),
      options_(std::move(options)),
      server_(std::move(server)),
      thread_(thread),
      report_(thread.reports[kind.name]),
      number_(number),
      random_(number) {
  options_.check_hashes = kind.verifies;
  options_.wrap_stream = [this](std::unique_ptr<ByteStream> stream) {
    return make_load_stream(std::move(stream), kind_.link, meter_);
  };
}

asio::awaitable<void> ScriptedClient::run(Clock::time_point start) {
  bool goes_on = co_await sleep_until(start);
  Clock::time_point due = Clock::now();
  std::chrono::milliseconds pause = kFirstPause;
  for (std::uint32_t round = 0; goes_on && (!kind_.rounds || round < *kind_.rounds); ++round) {
    Clock::duration lateness{};
    if (kind_.every) {
      if (round > 0) due += *kind_.every;
      goes_on = co_await sleep_until(due);
      if (!goes_on) break;
      lateness = std::max(Clock::duration::zero(), Clock::now() - due);
      if (lateness > std::chrono::milliseconds(1)) ++report_.late_rounds;
    }
    const bool went_well = co_await run_round(lateness);
    if (went_well) {
      pause = kFirstPause;
    } else if (!thread_.bounds.is_over()) {
      goes_on = co_await sleep_until(Clock::now() + pause);
      pause = std::min(2 * pause, kLongestPause);
    }
    goes_on = goes_on && !thread_.bounds.is_over();
  }
  disconnect();
  report_.received_bytes += meter_.received;
}

/// False after an error, or when the time is up.
asio::awaitable<bool> ScriptedClient::run_round(Clock::duration lateness) {
  for (const LoadStep& step : kind_.steps) {
    if (step.kind == LoadStep::Kind::Think) {
      std::uniform_int_distribution<std::int64_t> draw(step.think_least.count(), step.think_most.count());
      const std::chrono::milliseconds time(draw(random_));
      if (!co_await sleep_until(Clock::now() + time)) co_return false;
      continue;
    }
    if (step.kind == LoadStep::Kind::Disconnect) {
      disconnect();
      continue;
    }
    // Garbage has a connection of its own.
    Result<void> connected;
    if (step.kind != LoadStep::Kind::Garbage) connected = co_await connect();
    if (!connected) {
      note("connect", connected.error());
      co_return false;
    }
    if (!thread_.bounds.allow()) co_return false;
    const auto begin = Clock::now();
    const std::uint64_t before = meter_.received;
    Result<void> outcome = co_await perform(step);
    thread_.live.bytes += meter_.received - before;
    if (!outcome) {
      note(step.label, outcome.error());
      disconnect();
      co_return false;
    }
    const auto latency = Clock::now() - begin + lateness;
    report_.latency[step.label].add(latency);
    thread_.live.latency.add(step.label, latency);
    ++report_.requests;
    ++thread_.live.requests;
    thread_.live.latency_us +=
        static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(latency).count());
  }
  co_return true;
}

asio::awaitable<Result<void>> ScriptedClient::connect() {
  if (session_) co_return Result<void>();
  const auto begin = Clock::now();
  Result<std::shared_ptr<ClientSession>> session = co_await ClientSession::connect(server_, options_);
  if (!session) co_return forward_error(session);
  report_.latency["connect"].add(Clock::now() - begin);
  session_ = std::move(*session);
  ++thread_.live.connected;
  co_return Result<void>();
}

void ScriptedClient::disconnect() {
  if (!session_) return;
  session_->close();
  session_.reset();
  --thread_.live.connected;
}

/// False if the test ends before then.
asio::awaitable<bool> ScriptedClient::sleep_until(Clock::time_point time) {
  // In short spells, since the end may be brought forward.
  while (Clock::now() < time && !thread_.bounds.is_over()) {
    asio::steady_timer timer(thread_.io);
    timer.expires_at(std::min(time, Clock::now() + std::chrono::milliseconds(250)));
    co_await timer.async_wait(kAwait);
  }
  co_return !thread_.bounds.is_over();
}

asio::awaitable<Result<void>> ScriptedClient::perform(const LoadStep& step) {
  if (step.kind == LoadStep::Kind::List) {
    auto models = co_await session_->list();
    if (!models) co_return forward_error(models);
  } else if (step.kind == LoadStep::Kind::Open) {
    auto manifest = co_await session_->open(step.model);
    if (!manifest) co_return forward_error(manifest);
    manifest_ = thread_.manifests.emplace((*manifest)->pack_id, *manifest).first->second;
  } else if (step.kind == LoadStep::Kind::Get) {
    co_return co_await get(step);
  } else if (step.kind == LoadStep::Kind::Stall) {
    co_return co_await stall(step);
  } else if (step.kind == LoadStep::Kind::Vanish) {
    co_return co_await vanish(step);
  } else if (step.kind == LoadStep::Kind::Publish) {
    co_return co_await publish(step);
  } else {
    co_return co_await send_garbage(server_, step.bytes, random_());
  }
  co_return Result<void>();
}

/// Under a name of its own, so that clients do not replace each other's.
asio::awaitable<Result<void>> ScriptedClient::publish(const LoadStep& step) {
  std::shared_ptr<const std::vector<std::byte>>& file = thread_.files[step.file];
  if (!file) {
    auto read = read_file(step.file);
    if (!read) co_return forward_error(read);
    file = std::make_shared<const std::vector<std::byte>>(std::move(*read));
  }
  PublishRequest request;
  request.what.name = step.model + "-" + std::to_string(number_);
  request.what.file = step.file.filename().string();
  request.what.size_bytes = file->size();
  request.what.hash = hash_of(*file);
  request.what.replace = true;
  request.read = [bytes = file](std::uint64_t offset, std::span<std::byte> into) -> Result<std::size_t> {
    const auto rest = std::span(*bytes).subspan(std::min<std::size_t>(offset, bytes->size()));
    const auto count = std::min(rest.size(), into.size());
    std::ranges::copy(rest.first(count), into.begin());
    return count;
  };
  OnPublishState ignore = [](const PublishState&) {};
  auto published = co_await session_->publish(std::move(request), std::move(ignore));
  if (!published) co_return forward_error(published);
  co_return Result<void>();
}

/// Asks for everything, and reads nothing for a while. Whether the server waits or hangs up is its business.
asio::awaitable<Result<void>> ScriptedClient::stall(const LoadStep& step) {
  GetRequest request{manifest_, {}};
  meter_.is_stalled = true;
  std::stop_source stop;
  asio::steady_timer timer(thread_.io);
  timer.expires_after(step.stall);
  timer.async_wait([stop](const boost::system::error_code& error) mutable {
    if (!error) stop.request_stop();
  });
  ClientSession::OnPart ignore = [](ReceivedPart) {};
  const auto stats = co_await session_->get(std::move(request), std::move(ignore), stop.get_token());
  timer.cancel();
  disconnect();
  meter_.is_stalled = false;
  report_.cancelled += !stats;
  co_return Result<void>();
}

/// Goes without a word in the middle of an answer.
asio::awaitable<Result<void>> ScriptedClient::vanish(const LoadStep& step) {
  GetRequest request{manifest_, {}};
  meter_.break_at = meter_.received + std::max<std::uint64_t>(step.bytes, 1);
  ClientSession::OnPart ignore = [](ReceivedPart) {};
  const auto stats = co_await session_->get(std::move(request), std::move(ignore));
  const bool has_vanished = !stats && meter_.has_broken();
  meter_.break_at = ~std::uint64_t{0};
  disconnect();
  if (!stats && !has_vanished) co_return tl::unexpected(stats.error());
  report_.cancelled += has_vanished;
  co_return Result<void>();
}

asio::awaitable<Result<void>> ScriptedClient::get(const LoadStep& step) {
  GetRequest request{manifest_, step.random_percent ? random_share(step) : step.selection};
  request.urgency = step.urgency;
  auto selection = resolve_names(manifest_->directory, std::move(request.selection));
  if (!selection) co_return forward_error(selection);
  request.selection = std::move(*selection);

  const auto begin = Clock::now();
  bool is_first = true;
  std::uint64_t bytes = 0, parts = 0;
  const auto first_region = [this, begin, &is_first] {
    if (std::exchange(is_first, false)) report_.first_region.add(Clock::now() - begin);
  };
  const auto check =
      kind_.decodes ? std::make_shared<DecodeCheck>(thread_.io, thread_.workers, manifest_) : nullptr;
  ClientSession::OnPart on_part = [&](ReceivedPart part) {
    bytes += part.bytes.size();
    ++parts;
    if (check) {
      check->add(std::move(part), first_region);
    } else if (part.id.kind == PartKind::Region) {
      first_region();
    }
  };

  Result<void> outcome;
  bool is_cancelled = false;
  const Selection selected = request.selection;
  if (step.drop_after_bytes) {
    outcome = co_await get_with_drop(step, std::move(request), std::move(on_part));
  } else {
    std::stop_source stop;
    asio::steady_timer timer(thread_.io);
    if (step.cancel_after) {
      timer.expires_after(*step.cancel_after);
      timer.async_wait([stop](const boost::system::error_code& error) mutable {
        if (!error) stop.request_stop();
      });
    }
    auto stats = co_await session_->get(std::move(request), std::move(on_part), stop.get_token());
    timer.cancel();
    is_cancelled = !stats && stop.stop_requested() && stats.error().code == ErrorCode::Cancelled;
    if (!stats && !is_cancelled) outcome = forward_error(stats);
  }
  const bool verifies = kind_.verifies && outcome && !is_cancelled;
  if (check) {
    std::optional<Selection> verified;
    if (verifies) verified = selected;
    Result<void> decoded = co_await check->finish(std::move(verified));
    if (outcome) outcome = decoded;
  }
  if (!outcome) co_return outcome;
  report_.cancelled += is_cancelled;
  report_.verified += verifies;
  report_.parts += parts;
  if (!is_cancelled) report_.useful_bytes += bytes;
  co_return Result<void>();
}

/// Loses its connection once on the way, and fetches the rest over another.
asio::awaitable<Result<void>> ScriptedClient::get_with_drop(const LoadStep& step, GetRequest request,
                                                            ClientSession::OnPart on_part) {
  Result<MissingParts> missing = MissingParts::of(manifest_->directory, request.selection);
  if (!missing) co_return forward_error(missing);
  request.unfinished = std::make_shared<UnfinishedParts>();
  meter_.break_at = meter_.received + std::max<std::uint64_t>(*step.drop_after_bytes, 1);
  for (;;) {
    request.have = missing->held();
    ClientSession::OnPart take = [&](ReceivedPart part) {
      if (missing->take(part.id)) on_part(std::move(part));
    };
    auto stats = co_await session_->get(request, std::move(take));
    const bool has_dropped = !stats && meter_.has_broken();
    meter_.break_at = ~std::uint64_t{0};
    if (stats) co_return Result<void>();
    if (!has_dropped) co_return forward_error(stats);
    ++report_.dropped;
    disconnect();
    Result<void> connected = co_await connect();
    if (!connected) co_return connected;
  }
}

/// At least one region.
Selection ScriptedClient::random_share(const LoadStep& step) {
  Selection selection = step.selection;
  selection.kind = Selection::Kind::Ids;
  const std::uint32_t regions = manifest_->directory.real_region_count();
  for (RegionId id = 1; id <= regions; ++id) {
    if (random_() % 100 < static_cast<unsigned>(*step.random_percent)) selection.ids.push_back(id);
  }
  if (selection.ids.empty() && regions > 0)
    selection.ids.push_back(1 + static_cast<RegionId>(random_() % regions));
  return selection;
}

void ScriptedClient::note(const std::string& label, const Error& error) {
  ++report_.errors[label + ": " + std::string(to_string(error.code))];
  ++thread_.live.errors;
}

}  // namespace selvage
