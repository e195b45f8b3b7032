// SPDX-License-Identifier: MIT
#include "common/base/stop_on_interrupt.h"

#include <csignal>
#include <semaphore>

#include <gtest/gtest.h>

namespace selvage {
namespace {

/// Returns once the stop was requested; the test's time limit is what ends a wait in vain.
void wait_for_stop(const std::stop_token& stop) {
  std::binary_semaphore stopped(0);
  const std::stop_callback tells(stop, [&] { stopped.release(); });
  stopped.acquire();
}

TEST(StopOnInterrupt, ASignalRequestsAStop) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const StopOnInterrupt interrupt;
    EXPECT_FALSE(interrupt.token().stop_requested());
    std::raise(signal);
    wait_for_stop(interrupt.token());
  }
}

TEST(StopOnInterrupt, LeavesWithoutASignal) {
  std::stop_token token;
  {
    const StopOnInterrupt interrupt;
    token = interrupt.token();
  }
  EXPECT_FALSE(token.stop_requested());
}

TEST(StopOnInterrupt, TheSecondSignalEndsTheProcess) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        const StopOnInterrupt interrupt;
        std::raise(SIGINT);
        wait_for_stop(interrupt.token());
        std::raise(SIGINT);
      },
      ::testing::KilledBySignal(SIGINT), "");
}

TEST(StopOnInterrupt, SignalsAreAsBeforeOnceItIsGone) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        { const StopOnInterrupt interrupt; }
        std::raise(SIGTERM);
      },
      ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace selvage
