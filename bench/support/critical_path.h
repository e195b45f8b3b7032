// SPDX-License-Identifier: MIT
//
// What several idle cores would bring, measured on a machine that is not idle.
#pragma once

#include <cstddef>

#include "common/base/parallel.h"

namespace selvage::bench {

/// CPU time of the calling thread, ms. It stands still while others have the core.
double thread_cpu_ms();

/// Runs parallel loops on two threads and notes the CPU time of every body. From these follows how long two
/// cores would have been busy that had nothing else to do: bodies go, in order, to whichever is free first.
/// What the threads cost each other in caches and memory is in the measured times; what a scheduler adds is
/// not.
class CriticalPath {
 public:
  /// Must be outlived by this object, and called from one thread.
  ParallelFor parallel_for();

  /// Runs `work` on this thread and returns its critical path in ms.
  template <class Work>
  double measure(Work&& work) {
    elsewhere_ms_ = on_two_cores_ms_ = 0;
    const double start = thread_cpu_ms();
    work();
    return thread_cpu_ms() - start - elsewhere_ms_ + on_two_cores_ms_;
  }

 private:
  void run(std::size_t count, const std::function<void(std::size_t)>& body);

  double elsewhere_ms_ = 0;     // of this thread's time, what went into bodies
  double on_two_cores_ms_ = 0;  // of all bodies
};

}  // namespace selvage::bench
