// SPDX-License-Identifier: MIT
//
// A small HTTP server for those who look after this one: /metrics, /healthz, /readyz. It has a thread and an
// address of its own, so that it answers however busy the other is, and nobody else need reach it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/base/result.h"
#include "common/net/tcp_stream.h"

namespace selvage {

struct HealthPages {
  std::function<std::string()> metrics;     ///< in Prometheus's text format
  std::function<Result<void>()> readiness;  ///< why no client should be sent here
};

class HealthServer {
 public:
  /// Serves until it is destroyed; `pages` are called on its thread. Unavailable or InvalidArgument.
  static Result<std::unique_ptr<HealthServer>> start(const HostPort& address, HealthPages pages);
  ~HealthServer();

  HostPort address() const;  ///< with the port that was picked

 private:
  struct Impl;
  explicit HealthServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace selvage
