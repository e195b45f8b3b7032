// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <thread>

namespace selvage {

/// As long as it lives, SIGINT (Ctrl-C) and SIGTERM request a stop instead of ending the process. Only the
/// first of each: a second one ends the process as usual, whatever it is doing. One at a time in a process.
///
///     const StopOnInterrupt interrupt;
///     auto model = Model::open(source, options, interrupt.token());
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watcher_;
};

}  // namespace selvage
