// SPDX-License-Identifier: MIT
#include "common/net/deadline.h"

#include "common/net/await.h"

namespace selvage {

Deadline::Deadline(boost::asio::any_io_executor executor)
    : timer_(std::move(executor), Clock::time_point::max()) {}

void Deadline::expires_after(Clock::duration duration) {
  at_ = Clock::now() + duration;
  if (at_ < timer_.expiry()) timer_.cancel();  // wakes expired(), which waits anew
}

boost::asio::awaitable<void> Deadline::expired() {
  while (Clock::now() < at_) {
    timer_.expires_at(at_);
    // Also ends when the deadline is brought forward. When this coroutine is cancelled, the next round
    // throws.
    co_await timer_.async_wait(kAwait);
  }
}

}  // namespace selvage
