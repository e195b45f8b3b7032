// SPDX-License-Identifier: MIT
//
// Runs a load script against a server and counts. Clients do not decode: the load is the server's.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "client/load/latency_histogram.h"
#include "client/load/load_script.h"
#include "common/net/tcp_stream.h"

namespace selvage {

struct LoadOptions {
  HostPort server;
  std::uint32_t clients = 1;
  std::chrono::milliseconds duration{10'000};  ///< no step begins later
  std::uint64_t max_requests = 1'000'000;      ///< over all clients; no step begins beyond it
  unsigned threads = 0;                        ///< that do the network; 0: one
};

struct LoadReport {
  std::map<std::string, LatencyHistogram> latency;   ///< by kind of step, and "connect"
  LatencyHistogram first_region;                     ///< from the start of a get to its first whole part
  std::map<std::string, std::uint64_t> errors;       ///< by error code
  std::uint64_t requests = 0, parts = 0, bytes = 0;  ///< bytes of parts
  std::chrono::duration<double> elapsed{};
};

/// All clients start at once; each runs the script over its own connection and stops at its first error.
/// Latency is from sending a request to its answer: a client that waits for a slow server sends less, so this
/// does not correct for coordinated omission.
LoadReport run_load(const LoadScript& script, const LoadOptions& options);

}  // namespace selvage
