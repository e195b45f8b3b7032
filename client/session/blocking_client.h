// SPDX-License-Identifier: MIT
//
// A connection to a server, for code that may wait: the same as client_session.h, with a network thread of
// its own. The caller's thread gets the parts and may hand them on to others.
//
//     auto client = BlockingClient::connect({"127.0.0.1", 7878});
//     auto manifest = client->open("bunny");
//     auto stats = client->get({*manifest, {.ids = {3, 5}}}, [&](ReceivedPart part) -> Result<void> { ... });
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "client/session/client_session.h"

namespace selvage {

/// One thread at a time. Destroying it closes the connection; parts may outlive it.
class BlockingClient {
 public:
  /// Fails like ClientSession::connect; Cancelled soon after `stop`.
  static Result<BlockingClient> connect(const HostPort& server, ClientOptions options = {},
                                        std::stop_token stop = {});
  ~BlockingClient();
  BlockingClient(BlockingClient&&) noexcept;
  BlockingClient& operator=(BlockingClient&&) noexcept;

  Result<std::vector<ModelInfo>> list();
  Result<std::shared_ptr<const Manifest>> open(const std::string& name, std::stop_token stop = {});
  Result<std::chrono::steady_clock::duration> ping();
  Result<StatusReport> status();

  /// As ClientSession::publish. Both callbacks come on the network thread.
  Result<Published> publish(PublishRequest request, OnPublishState on_state, std::stop_token stop = {});
  Result<void> unpublish(const std::string& name);

  /// Called on the thread that called get(), with each verified part. An error cancels the rest.
  using OnPart = std::function<Result<void>(ReceivedPart)>;

  /// Returns when all parts have been handed over, or with the first error: the server's, the connection's or
  /// that of `on_part`. At most the window of ClientOptions is queued ahead of `on_part`.
  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token stop = {});

  /// Called like OnPart, once, before any part.
  using OnManifest = std::function<Result<void>(Manifest)>;
  /// As ClientSession::open_and_get.
  Result<GetStats> open_and_get(const std::string& name, FirstRequest request, const OnManifest& on_manifest,
                                const OnPart& on_part, std::stop_token stop = {});

 private:
  class Network;
  template <class Begin>
  Result<GetStats> receive(const Begin& begin, const OnManifest& on_manifest, const OnPart& on_part,
                           std::stop_token stop);
  explicit BlockingClient(std::unique_ptr<Network> network);

  std::unique_ptr<Network> network_;
};

/// Connects to a server that a person named, as HOST:PORT. Errors name it.
Result<BlockingClient> connect_to(const std::string& server, ClientOptions options,
                                  std::stop_token stop = {});

}  // namespace selvage
