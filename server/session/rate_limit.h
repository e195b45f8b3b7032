// SPDX-License-Identifier: MIT
//
// How many bytes may go out now, so that in the long run no more go out a second than allowed. A token
// bucket; pure, the caller brings the time.
#pragma once

#include <chrono>
#include <cstdint>

namespace selvage {

class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// `bytes_per_second` 0: no limit. After a pause up to `burst` bytes go at once.
  RateLimit(std::uint64_t bytes_per_second, std::uint64_t burst, Clock::time_point now);

  /// Bytes that may go now.
  std::uint64_t available(Clock::time_point now);
  /// Also for what goes whatever the limit says: it is missing later.
  void spend(std::uint64_t bytes);
  /// How long until `bytes` (at most the burst) are available.
  Clock::duration wait_for(std::uint64_t bytes, Clock::time_point now);

 private:
  void refill(Clock::time_point now);

  double per_second_;
  double burst_;
  double bytes_;  ///< below 0 when more was spent than there was
  Clock::time_point filled_at_;
};

}  // namespace selvage
