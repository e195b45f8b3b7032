// SPDX-License-Identifier: MIT
#include "client/app/progress_bar.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

const FetchProgress kHalf{
    .regions = 12, .of_regions = 21, .parts = 20, .of_parts = 40, .bytes = 1'700'000, .of_bytes = 3'400'000};

TEST(ProgressText, SaysHowFarHowFastHowLong) {
  EXPECT_EQ(progress_text(kHalf, 425'000, 120),
            "[##########..........] 12 of 21 regions, 1.7 MB of 3.4 MB, 425 KB/s, 4 s left");
}

TEST(ProgressText, FitsTheTerminal) {
  for (std::size_t width = 0; width < 100; ++width)
    EXPECT_LE(progress_text(kHalf, 425'000, width).size(), width);
  EXPECT_EQ(progress_text(kHalf, 425'000, 45), "[##########..........] 12 of 21 regions");
}

TEST(ProgressText, CopesWithNothing) {
  EXPECT_EQ(progress_text({}, 0, 80), "[####################] 0 of 0 regions, 0 B of 0 B");
}

TEST(ProgressText, CountsWhatCameWhileTheWholeIsUnknown) {
  const FetchProgress some{.regions = 3, .parts = 5, .bytes = 1'700'000};
  EXPECT_EQ(progress_text(some, 425'000, 120), "[....................] 3 regions, 1.7 MB, 425 KB/s");
}

TEST(ProgressText, DoesNotPromiseWhatItDoesNotKnow) {
  EXPECT_EQ(progress_text(kHalf, 0, 120).find("left"), std::string::npos);
}

}  // namespace
}  // namespace selvage
