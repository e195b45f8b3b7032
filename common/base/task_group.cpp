// SPDX-License-Identifier: MIT
#include "common/base/task_group.h"

#include <utility>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace selvage {

struct TaskGroup::Impl {
  tbb::task_arena arena;
  tbb::task_group group;
};

TaskGroup::TaskGroup(unsigned threads) {
  if (threads == 1) return;
  // The caller only hands out work, so it counts for none of the threads.
  const int concurrency = threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
  impl_ = std::make_unique<Impl>();
  impl_->arena.initialize(concurrency, 0);
}

TaskGroup::~TaskGroup() {
  if (impl_) impl_->arena.execute([&] { impl_->group.wait(); });
}

void TaskGroup::run(std::function<void()> task) {
  if (!impl_) return task();
  impl_->arena.enqueue(impl_->group.defer(std::move(task)));
}

void TaskGroup::wait() {
  if (impl_) impl_->arena.execute([&] { impl_->group.wait(); });
}

}  // namespace selvage
