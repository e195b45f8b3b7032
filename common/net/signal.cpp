// SPDX-License-Identifier: MIT
#include "common/net/signal.h"

#include "common/net/await.h"

namespace selvage {

void Signal::notify() {
  notified_ = true;
  if (timer_) timer_->cancel();
}

boost::asio::awaitable<void> Signal::wait() {
  return wait_until(std::chrono::steady_clock::time_point::max());
}

boost::asio::awaitable<void> Signal::wait_for(std::chrono::steady_clock::duration at_most) {
  return wait_until(std::chrono::steady_clock::now() + at_most);
}

boost::asio::awaitable<void> Signal::wait_until(std::chrono::steady_clock::time_point at_latest) {
  if (!notified_) {
    timer_ =
        std::make_unique<boost::asio::steady_timer>(co_await boost::asio::this_coro::executor, at_latest);
    co_await timer_->async_wait(kAwait);
    timer_.reset();
  }
  notified_ = false;
}

}  // namespace selvage
