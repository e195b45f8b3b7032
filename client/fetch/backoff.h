// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>

namespace selvage {

/// When to try again after failures that may pass, and when to stop.
struct RetryPolicy {
  std::chrono::milliseconds first_delay{200};
  std::chrono::milliseconds longest_delay{10'000};
  std::chrono::milliseconds give_up_after{
      60'000};  ///< of failing without a byte arriving; 0: never try again
};

/// Delays that double from try to try, each drawn from the upper half of what has been reached, so that many
/// clients that lose a server at the same moment do not come back at the same moment.
class Backoff {
 public:
  Backoff(const RetryPolicy& policy, std::uint64_t seed) : policy_(policy), random_(seed) {}

  std::chrono::milliseconds next() {
    const auto most = std::min(policy_.longest_delay, policy_.first_delay * (std::int64_t{1} << doublings_));
    if (doublings_ < 20) ++doublings_;
    std::uniform_int_distribution<std::int64_t> draw((most.count() + 1) / 2, most.count());
    return std::chrono::milliseconds(draw(random_));
  }

  /// Things went well: the next failure is a first one.
  void reset() { doublings_ = 0; }

 private:
  const RetryPolicy policy_;
  std::mt19937_64 random_;
  int doublings_ = 0;
};

}  // namespace selvage
