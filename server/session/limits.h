// SPDX-License-Identifier: MIT
//
// What one client may cost. Every queue, wait and count of a session is bounded by one of these, and each
// bound is reached by a test.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace selvage {

struct SessionLimits {
  std::chrono::milliseconds handshake_timeout{10'000};  ///< from accept to a whole Hello
  std::chrono::milliseconds idle_timeout{120'000};      ///< between whole frames from the client
  std::chrono::milliseconds write_timeout{30'000};  ///< for the kernel to take one write (at most ~260 KiB)

  std::uint32_t message_bytes = 512u << 10;  ///< payload of one frame from the client
  std::uint32_t requests = 32;               ///< gets and opens being answered at a time
  std::uint32_t ids_per_request = 65'536;
  std::uint32_t queued_parts = 1u << 18;    ///< parts still to be sent, over all requests; 24 bytes each
  std::uint32_t queued_bytes = 256u << 10;  ///< of control frames; reading pauses while there are more
  std::uint64_t bytes_per_second = 0;       ///< that the client is sent; 0: as many as it takes
  std::uint32_t opened_models = 64;         ///< the longest-open one is forgotten beyond that
};

struct ServerLimits {
  std::uint32_t connections = 4096;                  ///< at a time; more are told so and closed
  std::uint32_t connections_per_address = 1024;      ///< the same for each address (IPv6: its first 64 bits)
  std::chrono::milliseconds shutdown_grace{10'000};  ///< for requests in flight, then they are cut off
  SessionLimits session;
};

}  // namespace selvage
