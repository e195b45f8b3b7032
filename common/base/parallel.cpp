// SPDX-License-Identifier: MIT
#include "common/base/parallel.h"

#include <memory>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

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
    arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); }); });
  };
}

}  // namespace selvage
