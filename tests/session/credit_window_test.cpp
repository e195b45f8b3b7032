// SPDX-License-Identifier: MIT
#include "client/session/credit_window.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(CreditWindow, GrantsInQuarters) {
  CreditWindow window(1000);
  EXPECT_EQ(window.take_grant(), 0u);
  EXPECT_TRUE(window.receive(249));
  EXPECT_EQ(window.take_grant(), 0u);
  EXPECT_TRUE(window.receive(1));
  EXPECT_EQ(window.take_grant(), 250u);
}

TEST(CreditWindow, KnowsWhenItIsOverrun) {
  CreditWindow window(1000);
  EXPECT_TRUE(window.receive(1000));
  EXPECT_FALSE(window.receive(1));
}

TEST(CreditWindow, GrantsNothingWhileWholePartsFillIt) {
  CreditWindow window(1000);
  EXPECT_TRUE(window.receive(1000));
  window.hold(900);
  EXPECT_EQ(window.take_grant(), 0u);
  window.release(400);
  EXPECT_EQ(window.take_grant(), 500u);
}

TEST(Receipt, TellsOnceUntilAsked) {
  int told = 0;
  const auto consumed = std::make_shared<ConsumedBytes>([&] { ++told; });
  { Receipt a(consumed, 10), b(consumed, 20); }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(consumed->take(), 30u);
  { const Receipt c(consumed, 1); }
  EXPECT_EQ(told, 2);
}

TEST(Receipt, MovesWithoutCountingTwice) {
  const auto consumed = std::make_shared<ConsumedBytes>([] {});
  {
    Receipt a(consumed, 10);
    Receipt b(std::move(a));
    a = std::move(b);
    EXPECT_EQ(consumed->take(), 0u);
  }
  EXPECT_EQ(consumed->take(), 10u);
}

TEST(Receipt, MayGoOnAnyThreadAndAfterTheSession) {
  const auto consumed = std::make_shared<ConsumedBytes>([] {});
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([consumed] {
      for (int n = 0; n < 1000; ++n) const Receipt receipt(consumed, 1);
    });
  }
  consumed->close();
  threads.clear();
  EXPECT_EQ(consumed->take(), 4000u);
}

}  // namespace
}  // namespace selvage
