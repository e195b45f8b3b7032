// SPDX-License-Identifier: MIT
#include "common/base/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (unsigned threads : {0u, 1u, 3u}) {
    std::vector<std::atomic<int>> visits(1000);
    threaded_for(threads)(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST(Parallel, RethrowsWhatABodyThrows) {
  EXPECT_THROW(threaded_for(2)(10, [](std::size_t i) { if (i == 5) throw std::runtime_error("five"); }), std::runtime_error);
}

}  // namespace
}  // namespace selvage
