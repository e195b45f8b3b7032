// SPDX-License-Identifier: MIT
#include "client/load/latency_histogram.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(LatencyHistogram, PercentilesAreWithinOneInAHundred) {
  std::mt19937 random(4);
  std::lognormal_distribution<double> spread(14, 2);  // around a millisecond, over many octaves
  LatencyHistogram histogram;
  std::vector<std::int64_t> exact;
  for (int i = 0; i < 20'000; ++i) {
    exact.push_back(static_cast<std::int64_t>(spread(random)));
    histogram.add(std::chrono::nanoseconds(exact.back()));
  }
  std::sort(exact.begin(), exact.end());
  for (double quantile : {0.01, 0.5, 0.9, 0.99, 0.999}) {
    const auto expected = static_cast<double>(exact[static_cast<std::size_t>(quantile * 20'000) - 1]);
    EXPECT_NEAR(static_cast<double>(histogram.percentile(quantile).count()), expected, expected / 100 + 1);
  }
  EXPECT_EQ(histogram.percentile(1).count(), exact.back());
  EXPECT_EQ(histogram.max().count(), exact.back());
}

TEST(LatencyHistogram, MergesAndCopesWithNothing) {
  LatencyHistogram a, b;
  EXPECT_EQ(a.percentile(0.5).count(), 0);
  a.add(std::chrono::nanoseconds(5));
  b.add(std::chrono::hours(3));
  a.merge(b);
  EXPECT_EQ(a.count(), 2u);
  EXPECT_EQ(a.percentile(0.5).count(), 5);
  EXPECT_EQ(a.max(), std::chrono::hours(3));
}

}  // namespace
}  // namespace selvage
