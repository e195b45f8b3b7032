// SPDX-License-Identifier: MIT
//
// What a server has done so far, in numbers: sessions count, server/operate shows.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>

#include "common/base/result.h"

namespace selvage {

/// Thread-safe; each number by itself.
struct ServerCounters {
  using Count = std::atomic<std::uint64_t>;

  const std::chrono::system_clock::time_point started = std::chrono::system_clock::now();

  Count connections{0};          ///< accepted, ever
  Count connections_refused{0};  ///< over a limit of connections
  Count sessions{0};             ///< at the moment
  Count lists{0}, opens{0}, gets{0}, statuses{0}, publishes{0}, unpublishes{0};  ///< requests
  Count bytes_sent{0};      ///< frames, before encryption
  Count bytes_uploaded{0};  ///< Data from publishers
  Count published{0}, publish_failed{0};
  std::array<Count, 16> errors{};  ///< sent to clients, by ErrorCode

  void count_error(ErrorCode code) {
    const auto index = static_cast<std::size_t>(code);
    if (index < errors.size()) ++errors[index];
  }
};

}  // namespace selvage
