// SPDX-License-Identifier: MIT
//
// "Something changed, look again" from one coroutine to another on the same strand.
#pragma once

#include <chrono>
#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>

namespace selvage {

/// Single-strand, one waiter at a time. A notify() before the wait is not lost; several count as one.
class Signal {
 public:
  void notify();

  /// Returns once notified, or when the waiting coroutine is cancelled.
  boost::asio::awaitable<void> wait();
  /// Or after so long.
  boost::asio::awaitable<void> wait_for(std::chrono::steady_clock::duration at_most);

 private:
  boost::asio::awaitable<void> wait_until(std::chrono::steady_clock::time_point at_latest);

  std::unique_ptr<boost::asio::steady_timer> timer_;  ///< while somebody waits; being cancelled is the event
  bool notified_ = false;
};

}  // namespace selvage
