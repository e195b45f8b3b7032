// SPDX-License-Identifier: MIT
#include "common/base/parallel.h"

#include <memory>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "common/base/handover.h"

namespace selvage {

ParallelFor serial_for() {
  return [](std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
  };
}

ParallelFor threaded_for(unsigned threads) {
  if (threads == 1) return serial_for();
  const int concurrency = threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
  auto arena = std::make_shared<tbb::task_arena>(concurrency);
  return [arena](std::size_t count, const std::function<void(std::size_t)>& body) {
    Handover begun, done;
    begun.give();
    const auto run = [&](std::size_t i) {
      begun.take();
      body(i);
      done.give();
    };
    arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, run); });
    done.take();
  };
}

}  // namespace selvage
