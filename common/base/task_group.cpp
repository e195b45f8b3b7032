// SPDX-License-Identifier: MIT
#include "common/base/task_group.h"

#include <utility>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "common/base/handover.h"

namespace selvage {

struct TaskGroup::Impl {
  tbb::task_arena arena;
  tbb::task_group group;
  Handover begun, done;
};

TaskGroup::TaskGroup(unsigned threads) {
  if (threads == 1) return;
  // The caller takes a place too: it hands out work first and helps once it waits.
  const int concurrency = threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
  impl_ = std::make_unique<Impl>();
  impl_->arena.initialize(concurrency, 1);
}

TaskGroup::~TaskGroup() {
  if (impl_) impl_->arena.execute([&] { impl_->group.wait(); });
}

void TaskGroup::run(std::function<void()> task) {
  if (!impl_) return task();
  impl_->begun.give();
  auto run = [impl = impl_.get(), task = std::move(task)] {
    impl->begun.take();
    task();
    impl->done.give();
  };
  impl_->arena.enqueue(impl_->group.defer(std::move(run)));
}

void TaskGroup::wait() {
  if (!impl_) return;
  impl_->arena.execute([&] { impl_->group.wait(); });
  impl_->done.take();
}

}  // namespace selvage
