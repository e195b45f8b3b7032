// SPDX-License-Identifier: MIT
#include "server/session/rate_limit.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

using namespace std::chrono_literals;
constexpr RateLimit::Clock::time_point kStart{};

TEST(RateLimit, LetsABurstGoThenTheRate) {
  RateLimit rate(1000, 500, kStart);
  EXPECT_EQ(rate.available(kStart), 500u);
  rate.spend(500);
  EXPECT_EQ(rate.available(kStart), 0u);
  EXPECT_EQ(rate.available(kStart + 100ms), 100u);
  EXPECT_EQ(rate.available(kStart + 10s), 500u);  // a pause is not saved up
}

TEST(RateLimit, WhatWentTooSoonIsMissingLater) {
  RateLimit rate(1000, 500, kStart);
  rate.spend(1500);
  EXPECT_EQ(rate.available(kStart + 900ms), 0u);
  EXPECT_EQ(rate.available(kStart + 1100ms), 100u);
}

TEST(RateLimit, SaysHowLongToWait) {
  RateLimit rate(1000, 500, kStart);
  EXPECT_EQ(rate.wait_for(500, kStart), 0ms);
  rate.spend(500);
  const auto wait = rate.wait_for(250, kStart);
  EXPECT_EQ(wait, 250ms);
  EXPECT_GE(rate.available(kStart + wait), 250u);
}

TEST(RateLimit, ZeroIsNoLimit) {
  RateLimit rate(0, 500, kStart);
  rate.spend(1u << 30);
  EXPECT_GT(rate.available(kStart), std::uint64_t{1} << 40);
  EXPECT_EQ(rate.wait_for(1000, kStart), 0ms);
}

}  // namespace
}  // namespace selvage
