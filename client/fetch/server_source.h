// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "client/session/part_source.h"
#include "client/session/blocking_client.h"

namespace selvage {

/// Parts from a selvage server. Connects when it is first used, and again when it is used after a connection
/// was lost.
class ServerSource final : public PartSource {
 public:
  ServerSource(HostPort server, std::string model, ClientOptions options)
      : server_(std::move(server)), model_(std::move(model)), options_(std::move(options)) {
    options_.await_greeting = false;  // the first request travels with ours
  }

  Result<std::shared_ptr<const Manifest>> open(std::stop_token stop = {}) override;
  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token stop = {}) override;
  /// In one round trip, the greeting included.
  Result<GetStats> open_and_get(FirstRequest request, const OnManifest& on_manifest, const OnPart& on_part,
                                std::stop_token stop = {}) override;

 private:
  Result<void> connect(const std::stop_token& stop);
  template <class T>
  Result<T> settled(Result<T> outcome);

  HostPort server_;
  std::string model_;
  ClientOptions options_;
  std::optional<BlockingClient> client_;  ///< absent: not connected
};

}  // namespace selvage
