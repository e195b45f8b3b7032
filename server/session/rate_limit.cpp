// SPDX-License-Identifier: MIT
#include "server/session/rate_limit.h"

#include <algorithm>
#include <limits>

namespace selvage {

RateLimit::RateLimit(std::uint64_t bytes_per_second, std::uint64_t burst, Clock::time_point now)
    : per_second_(static_cast<double>(bytes_per_second)),
      burst_(static_cast<double>(burst)),
      bytes_(burst_),
      filled_at_(now) {}

void RateLimit::refill(Clock::time_point now) {
  const std::chrono::duration<double> passed = now - filled_at_;
  bytes_ = std::min(burst_, bytes_ + per_second_ * passed.count());
  filled_at_ = now;
}

std::uint64_t RateLimit::available(Clock::time_point now) {
  if (per_second_ == 0) return std::numeric_limits<std::uint64_t>::max();
  refill(now);
  return static_cast<std::uint64_t>(std::max(bytes_, 0.0));
}

void RateLimit::spend(std::uint64_t bytes) {
  if (per_second_ != 0) bytes_ -= static_cast<double>(bytes);
}

RateLimit::Clock::duration RateLimit::wait_for(std::uint64_t bytes, Clock::time_point now) {
  if (per_second_ == 0) return {};
  refill(now);
  const double missing = std::max(0.0, static_cast<double>(bytes) - bytes_);
  // Rounded up: waking early would only mean waiting again.
  return std::chrono::ceil<Clock::duration>(std::chrono::duration<double>(missing / per_second_));
}

}  // namespace selvage
