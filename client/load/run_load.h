// SPDX-License-Identifier: MIT
//
// Runs a load script against a server and reports what its clients saw.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>

#include "client/load/load_report.h"
#include "client/load/load_script.h"
#include "client/session/client_options.h"
#include "common/net/tcp_stream.h"

namespace selvage {

struct LoadOptions {
  HostPort server;
  ClientOptions connection;                    ///< its limits are made small: there are many clients
  std::chrono::milliseconds duration{10'000};  ///< where the script says none; no step begins later
  std::chrono::milliseconds grace{10'000};     ///< for what is under way by then
  std::uint64_t max_requests = 100'000'000;    ///< over all clients; no step begins beyond it
  unsigned threads = 1;                        ///< that do the network
  unsigned decode_threads = 0;                 ///< where clients decode; 0: all cores
  std::chrono::milliseconds sample_every{1000};
  std::function<void(const LoadSample&)> on_sample = {};  ///< as the test goes on, on the calling thread
};

/// Returns when the script or the time is over, or `stop` is requested.
LoadReport run_load(const LoadScript& script, const LoadOptions& options, std::stop_token stop = {});

}  // namespace selvage
