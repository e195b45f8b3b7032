// SPDX-License-Identifier: MIT
#include "common/net/deadline.h"

#include "common/net/await.h"

namespace selvage {

Deadline::Deadline(boost::asio::any_io_executor executor)
    : timer_(std::move(executor), Clock::time_point::max()) {}

void Deadline::expires_at(Clock::time_point at) {
  at_ = at;
  if (at_ < timer_.expiry()) timer_.cancel();  // wakes expired(), which waits anew
}

void Deadline::on_expiry(std::function<void()> call) {
  call_ = std::make_shared<std::function<void()>>(std::move(call));
  watch();
}

void Deadline::stop() {
  call_.reset();
  timer_.cancel();
}

void Deadline::watch() {
  timer_.expires_at(at_);
  timer_.async_wait([this, stopped = std::weak_ptr(call_)](const boost::system::error_code&) {
    const auto call = stopped.lock();
    if (!call) return;
    const bool has_expired = Clock::now() >= at_;
    if (has_expired) clear();
    watch();
    if (has_expired) (*call)();
  });
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
