// SPDX-License-Identifier: MIT
#include "server/simplify/bridge_links.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

// 0 and 1 face 2 to 4: a strip of bridge edges 2-0, 3-0, 3-1, 4-1.
//
//    2 --- 3 --- 4
//     . / . . / .
//       0 --- 1
const std::vector<RegionId> kLabels = {1, 1, 2, 2, 2};

CornerTable strip() {
  const std::vector<Triangle> triangles = {{0, 3, 2}, {0, 1, 3}, {1, 4, 3}};
  return build_corner_table(triangles, 5);
}

TEST(BridgeLinks, AllowOneCommonNeighbour) {
  Stamps stamps(5);
  EXPECT_TRUE(BridgeLinks(strip(), kLabels).keep_one_common_neighbour(0, 1, stamps));
}

TEST(BridgeLinks, RefuseASecondOneAtAPublishedLevel) {
  Stamps stamps(5);
  BridgeLinks bridges(strip(), kLabels);
  bridges.publish({0, 1, 3, 3, 3});  // 2 and 4 have gone to 3: still one
  EXPECT_TRUE(bridges.keep_one_common_neighbour(0, 1, stamps));
  bridges.publish({0, 1, 2, 3, 2});  // 2 and 4 are one, beside 3
  EXPECT_FALSE(bridges.keep_one_common_neighbour(0, 1, stamps));
}

TEST(BridgeLinks, HandOnTheirEndsWhenAVertexGoes) {
  Stamps stamps(5);
  BridgeLinks bridges(strip(), kLabels);
  bridges.collapse(2, 4);                                         // now 0 and 1 both reach the vertex 4
  EXPECT_FALSE(bridges.keep_one_common_neighbour(4, 3, stamps));  // 0 and 1 are common to 3 and 4
}

}  // namespace
}  // namespace selvage
