// SPDX-License-Identifier: MIT
//
// The client side of the comparison: one thread, many connections, each with one request in flight. It counts
// answers and throws them away, whichever of the two protocols they are in, so that what differs is the
// server.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace selvage::bench {

enum class Speech { Http, Selvage };

struct LoopPlan {
  Speech speech = Speech::Http;
  std::uint16_t port = 0;
  unsigned connections = 1;
  double seconds = 1;
  /// Said once on each new connection, whose answer is not waited for; may be empty.
  std::string greeting;
  std::function<std::string(std::mt19937&)> request;
};

struct LoopResult {
  std::uint64_t answers = 0;
  std::uint64_t bytes = 0;  ///< received in them
  double seconds = 0;
  std::vector<double> latencies;  ///< seconds, ascending
  double quantile(double share) const;
};

/// Throws std::runtime_error when a server does not answer as it should.
LoopResult run_closed_loop(const LoopPlan& plan);

/// A blocking connection. `address`: in digits.
int connect_to(std::uint16_t port, const std::string& address = "127.0.0.1");

}  // namespace selvage::bench
