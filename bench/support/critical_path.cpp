// SPDX-License-Identifier: MIT
#include "bench/support/critical_path.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <thread>
#include <vector>

namespace selvage::bench {

double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

ParallelFor CriticalPath::parallel_for() {
  return [this](std::size_t count, const std::function<void(std::size_t)>& body) { run(count, body); };
}

void CriticalPath::run(std::size_t count, const std::function<void(std::size_t)>& body) {
  const double start = thread_cpu_ms();
  std::vector<double> ms(count);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      const double begin = thread_cpu_ms();
      body(i);
      ms[i] = thread_cpu_ms() - begin;
    }
  };
  std::thread other(work);
  work();
  other.join();
  double busy[2] = {0, 0};
  for (double body_ms : ms) *std::min_element(busy, busy + 2) += body_ms;
  on_two_cores_ms_ += std::max(busy[0], busy[1]);
  elsewhere_ms_ += thread_cpu_ms() - start;
}

}  // namespace selvage::bench
