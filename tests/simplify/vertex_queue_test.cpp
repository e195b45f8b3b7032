// SPDX-License-Identifier: MIT
#include "server/simplify/vertex_queue.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace selvage {
namespace {

constexpr std::uint32_t kCount = 20000;  // several blocks

// Against a set, under random changes.
TEST(VertexQueue, GivesTheLowestKeyTiesByNumber) {
  std::mt19937 random(1);
  VertexQueue queue(kCount);
  std::set<std::pair<double, VertexId>> expected;
  for (int i = 0; i < 200000; ++i) {
    const VertexId v = random() % kCount;
    if (queue.contains(v)) expected.erase({queue.key(v), v});
    if (random() % 3 == 0) {
      if (queue.contains(v)) queue.remove(v);
    } else {
      const double key = random() % 1000;
      queue.set(v, key);
      expected.insert({key, v});
    }
    ASSERT_EQ(queue.is_empty(), expected.empty());
    if (!expected.empty()) {
      ASSERT_EQ(queue.top(), expected.begin()->second);
    }
  }
}

TEST(VertexQueue, WithPatienceStaysWithinItAndLosesNothing) {
  std::mt19937 random(2);
  VertexQueue queue(kCount);
  std::multiset<double> keys;
  for (VertexId v = 0; v < kCount; ++v) {
    const double key = 1 + random() % 100000;
    queue.set(v, key);
    keys.insert(key);
  }
  queue.set_patience(1.5);
  std::uint32_t blocks_entered = 0, block = kNone;
  for (VertexId v = 0; !queue.is_empty(); queue.remove(v)) {
    v = queue.top();
    ASSERT_LE(queue.key(v), 1.5 * *keys.begin());
    keys.erase(keys.find(queue.key(v)));
    blocks_entered += std::exchange(block, v / 4096) != v / 4096;
  }
  EXPECT_TRUE(keys.empty());
  EXPECT_LT(blocks_entered, 200u) << "it is for staying";
}

}  // namespace
}  // namespace selvage
