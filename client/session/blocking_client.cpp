// SPDX-License-Identifier: MIT
#include "client/session/blocking_client.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include <boost/asio/bind_cancellation_slot.hpp>
#include <boost/asio/cancellation_signal.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_future.hpp>

namespace selvage {
namespace {

/// Parts on their way from the network thread to the one that waits in get(). Bounded by the session's
/// window.
class PartQueue {
 public:
  void push(ReceivedPart part) {
    const std::lock_guard lock(mutex_);
    parts_.push_back(std::move(part));
    changed_.notify_one();
  }

  /// Before any part.
  void push(Manifest manifest) {
    const std::lock_guard lock(mutex_);
    manifest_ = std::move(manifest);
    changed_.notify_one();
  }

  void end(Result<GetStats> outcome) {
    const std::lock_guard lock(mutex_);
    outcome_ = std::move(outcome);
    changed_.notify_one();
  }

  struct News {
    std::optional<Manifest> manifest;
    std::deque<ReceivedPart> parts;
  };
  /// Waits for more; what has come since the last call. Empty once all has been given.
  News wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return manifest_ || !parts_.empty() || outcome_; });
    return {std::exchange(manifest_, std::nullopt), std::exchange(parts_, {})};
  }

  Result<GetStats> outcome() {
    const std::lock_guard lock(mutex_);
    return *outcome_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Manifest> manifest_;
  std::deque<ReceivedPart> parts_;
  std::optional<Result<GetStats>> outcome_;
};

/// Asks to stop when its scope is left, however that happens.
class StopAtExit {
 public:
  explicit StopAtExit(std::stop_source& source) : source_(source) {}
  ~StopAtExit() { source_.request_stop(); }
  StopAtExit(const StopAtExit&) = delete;
  StopAtExit& operator=(const StopAtExit&) = delete;

 private:
  std::stop_source& source_;
};

}  // namespace

class BlockingClient::Network {
 public:
  Network() : work_(asio::make_work_guard(io_)), thread_([this] { io_.run(); }) {}

  ~Network() {
    if (session_) asio::post(io_, [session = std::move(session_)] { session->close(); });
    work_.reset();
  }

  template <class T>
  T wait_for(asio::awaitable<T> work) {
    return asio::co_spawn(io_, std::move(work), asio::use_future).get();
  }

  Result<void> connect(const HostPort& server, ClientOptions options, const std::stop_token& stop) {
    const auto cancels = std::make_shared<asio::cancellation_signal>();
    auto connecting = asio::co_spawn(io_, ClientSession::connect(server, std::move(options)),
                                     asio::bind_cancellation_slot(cancels->slot(), asio::use_future));
    const std::stop_callback on_stop(stop, [this, cancels] {
      asio::post(io_, [cancels] { cancels->emit(asio::cancellation_type::terminal); });
    });
    try {
      auto session = connecting.get();
      if (session) session_ = std::move(*session);
      if (!session && !stop.stop_requested()) return forward_error(session);
    } catch (const boost::system::system_error&) {
      // How a cancelled coroutine ends.
    }
    if (stop.stop_requested() || !session_) return fail(ErrorCode::Cancelled, "cancelled");
    return {};
  }

  ClientSession& session() { return *session_; }

  /// The outcome goes to `queue`.
  void run(asio::awaitable<Result<GetStats>> get, std::shared_ptr<PartQueue> queue) {
    auto on_end = [queue](std::exception_ptr thrown, Result<GetStats> outcome) {
      if (thrown) outcome = fail(ErrorCode::LimitExceeded, "out of memory while receiving");
      queue->end(std::move(outcome));
    };
    asio::co_spawn(io_, std::move(get), std::move(on_end));
  }

 private:
  asio::io_context io_{1};
  asio::executor_work_guard<asio::io_context::executor_type> work_;
  std::shared_ptr<ClientSession> session_;
  std::jthread thread_;  ///< last: joined before what it uses goes
};

BlockingClient::BlockingClient(std::unique_ptr<Network> network) : network_(std::move(network)) {}
BlockingClient::~BlockingClient() = default;
BlockingClient::BlockingClient(BlockingClient&&) noexcept = default;
BlockingClient& BlockingClient::operator=(BlockingClient&&) noexcept = default;

Result<BlockingClient> BlockingClient::connect(const HostPort& server, ClientOptions options,
                                               std::stop_token stop) {
  auto network = std::make_unique<Network>();
  auto connected = network->connect(server, std::move(options), stop);
  if (!connected) return forward_error(connected);
  return BlockingClient(std::move(network));
}

Result<std::vector<ModelInfo>> BlockingClient::list() {
  return network_->wait_for(network_->session().list());
}

Result<std::shared_ptr<const Manifest>> BlockingClient::open(const std::string& name, std::stop_token stop) {
  return network_->wait_for(network_->session().open(name, std::move(stop)));
}

Result<std::chrono::steady_clock::duration> BlockingClient::ping() {
  return network_->wait_for(network_->session().ping());
}

Result<StatusReport> BlockingClient::status() { return network_->wait_for(network_->session().status()); }

Result<Published> BlockingClient::publish(PublishRequest request, OnPublishState on_state,
                                          std::stop_token stop) {
  return network_->wait_for(
      network_->session().publish(std::move(request), std::move(on_state), std::move(stop)));
}

Result<void> BlockingClient::unpublish(const std::string& name) {
  return network_->wait_for(network_->session().unpublish(name));
}

/// Runs the coroutine that `begin` makes, and hands on what it brings. An error of the caller's ends it.
template <class Begin>
Result<GetStats> BlockingClient::receive(const Begin& begin, const OnManifest& on_manifest,
                                         const OnPart& on_part, std::stop_token stop) {
  const auto queue = std::make_shared<PartQueue>();
  std::stop_source source;
  const StopAtExit stops(source);
  const std::stop_callback passes_on(stop, [&source] { source.request_stop(); });
  network_->run(begin(queue, source.get_token()), queue);
  for (;;) {
    auto [manifest, parts] = queue->wait();
    if (!manifest && parts.empty()) return queue->outcome();
    if (manifest) {
      auto taken = on_manifest(std::move(*manifest));
      if (!taken) return forward_error(taken);
    }
    for (; !parts.empty(); parts.pop_front()) {
      auto taken = on_part(std::move(parts.front()));
      if (!taken) return forward_error(taken);
    }
  }
}

Result<GetStats> BlockingClient::get(GetRequest request, const OnPart& on_part, std::stop_token stop) {
  const auto begin = [&](const std::shared_ptr<PartQueue>& queue, std::stop_token token) {
    auto push = [queue](ReceivedPart part) { queue->push(std::move(part)); };
    return network_->session().get(std::move(request), std::move(push), std::move(token));
  };
  return receive(begin, nullptr, on_part, std::move(stop));
}

Result<GetStats> BlockingClient::open_and_get(const std::string& name, FirstRequest request,
                                              const OnManifest& on_manifest, const OnPart& on_part,
                                              std::stop_token stop) {
  const auto begin = [&](const std::shared_ptr<PartQueue>& queue, std::stop_token token) {
    auto push_manifest = [queue](Manifest manifest) { queue->push(std::move(manifest)); };
    auto push = [queue](ReceivedPart part) { queue->push(std::move(part)); };
    return network_->session().open_and_get(name, std::move(request), std::move(push_manifest),
                                            std::move(push), std::move(token));
  };
  return receive(begin, on_manifest, on_part, std::move(stop));
}

Result<BlockingClient> connect_to(const std::string& server, ClientOptions options, std::stop_token stop) {
  auto address = parse_host_port(server);
  if (!address) return forward_error(address);
  auto client = BlockingClient::connect(*address, std::move(options), std::move(stop));
  if (!client) return forward_error(client, server);
  return client;
}

}  // namespace selvage
