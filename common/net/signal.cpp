// SPDX-License-Identifier: MIT
#include "common/net/signal.h"

#include "common/net/await.h"

namespace selvage {

Signal::Signal(boost::asio::any_io_executor executor)
    : timer_(std::move(executor), boost::asio::steady_timer::time_point::max()) {}

void Signal::notify() {
  notified_ = true;
  timer_.cancel();
}

boost::asio::awaitable<void> Signal::wait() {
  if (!notified_) co_await timer_.async_wait(kAwait);
  notified_ = false;
}

boost::asio::awaitable<void> Signal::wait_for(std::chrono::steady_clock::duration at_most) {
  if (!notified_) {
    timer_.expires_after(at_most);
    co_await timer_.async_wait(kAwait);
    timer_.expires_at(boost::asio::steady_timer::time_point::max());
  }
  notified_ = false;
}

}  // namespace selvage
