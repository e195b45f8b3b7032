// SPDX-License-Identifier: MIT
#include "client/fetch/backoff.h"

#include <set>

#include <gtest/gtest.h>

namespace selvage {
namespace {

using std::chrono::milliseconds;

TEST(Backoff, DoublesUpToItsBoundWithJitter) {
  const RetryPolicy policy{.first_delay = milliseconds(100), .longest_delay = milliseconds(1000)};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Backoff backoff(policy, seed);
    for (const int most : {100, 200, 400, 800, 1000, 1000, 1000}) {
      const milliseconds delay = backoff.next();
      EXPECT_GE(delay, milliseconds(most / 2));
      EXPECT_LE(delay, milliseconds(most));
    }
    backoff.reset();
    EXPECT_LE(backoff.next(), milliseconds(100));
  }
}

TEST(Backoff, ClientsDoNotComeBackTogether) {
  std::set<milliseconds> delays;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Backoff backoff({.first_delay = milliseconds(1000)}, seed);
    delays.insert(backoff.next());
  }
  EXPECT_GT(delays.size(), 50u);
}

TEST(Backoff, OutlastsAnyNumberOfTries) {
  Backoff backoff({.first_delay = milliseconds(1), .longest_delay = std::chrono::hours(1)}, 1);
  for (int i = 0; i < 200; ++i) EXPECT_LE(backoff.next(), std::chrono::hours(1));
}

}  // namespace
}  // namespace selvage
