// SPDX-License-Identifier: MIT
#include "common/base/stop_on_interrupt.h"

#include <atomic>
#include <cassert>
#include <csignal>
#include <cstddef>

#include <semaphore.h>

namespace selvage {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};

// What a signal handler may touch: it posts, the watcher waits.
::sem_t g_news;
std::atomic<bool> g_is_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

struct sigaction g_before[std::size(kSignals)];

extern "C" void selvage_on_interrupt(int) {
  g_is_interrupted = true;
  ::sem_post(&g_news);
}

}  // namespace

StopOnInterrupt::StopOnInterrupt() {
  g_is_interrupted = false;
  ::sem_init(&g_news, 0, 0);
  watcher_ = std::jthread([this] {
    while (::sem_wait(&g_news) != 0) {
    }
    if (g_is_interrupted) stop_.request_stop();
  });
  struct sigaction action {};
  action.sa_handler = selvage_on_interrupt;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &action, &g_before[i]);
}

StopOnInterrupt::~StopOnInterrupt() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &g_before[i], nullptr);
  ::sem_post(&g_news);  // nothing happened: the watcher may go
  watcher_.join();
  ::sem_destroy(&g_news);
}

}  // namespace selvage
