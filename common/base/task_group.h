// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

namespace selvage {

/// Runs tasks on worker threads while the caller goes on; for work that arrives piece by piece. The caller
/// bounds how much of it waits.
class TaskGroup {
 public:
  /// `threads` 0: as many as the machine has. With 1, run() does the work itself.
  explicit TaskGroup(unsigned threads);
  ~TaskGroup();  ///< waits
  TaskGroup(const TaskGroup&) = delete;
  TaskGroup& operator=(const TaskGroup&) = delete;

  void run(std::function<void()> task);
  /// Returns when every task is done; rethrows the first exception.
  void wait();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace selvage
