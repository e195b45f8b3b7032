// SPDX-License-Identifier: MIT
#include "common/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(DisjointSets, NamesASetByItsLowestElement) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.merge(5, 3));
  EXPECT_TRUE(sets.merge(4, 5));
  EXPECT_FALSE(sets.merge(3, 4));
  EXPECT_EQ(sets.set_of(5), 3u);
  EXPECT_EQ(sets.set_of(0), 0u);
  EXPECT_TRUE(sets.merge(4, 1));
  EXPECT_EQ(sets.set_of(5), 1u);
}

}  // namespace
}  // namespace selvage
