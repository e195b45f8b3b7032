// SPDX-License-Identifier: MIT
//
// A point in time that is put off again and again while things go well. Moving it later, as every frame does,
// costs a store: the timer underneath is only touched when it fires or when the deadline comes closer.
//
//     co_await (read_loop() || idle.expired());      // read_loop calls idle.expires_after(...) as it goes
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>

namespace selvage {

/// Single-strand, one waiter.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Deadline(boost::asio::any_io_executor executor);

  void expires_at(Clock::time_point at);
  void expires_after(Clock::duration duration) { expires_at(Clock::now() + duration); }
  void clear() { at_ = Clock::time_point::max(); }

  /// Returns when the deadline has passed; with none set it waits for one. Throws what Asio throws when
  /// the waiting coroutine is cancelled, which ends an `||` in the other's favour.
  boost::asio::awaitable<void> expired();

  /// For those who cannot afford a coroutine that waits: `call` is called when the deadline passes, which
  /// clears it, until stop(). That must be called on the strand before the deadline goes.
  void on_expiry(std::function<void()> call);
  void stop();

 private:
  void watch();

  boost::asio::steady_timer timer_;
  Clock::time_point at_ = Clock::time_point::max();
  std::shared_ptr<std::function<void()>> call_;
};

}  // namespace selvage
