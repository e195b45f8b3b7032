// SPDX-License-Identifier: MIT
#include "client/http/range_plan.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace selvage {
namespace {

WantedPiece piece(std::uint64_t begin, std::uint64_t end) { return {{}, begin, end}; }

TEST(RangePlan, PutsNeighboursTogether) {
  const auto ranges = plan_ranges({piece(100, 200), piece(0, 100), piece(210, 300), piece(1000, 1100)},
                                  {.max_gap = 20, .max_bytes = 10'000});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].begin, 0u);
  EXPECT_EQ(ranges[0].end, 300u);
  EXPECT_EQ(ranges[0].pieces.size(), 3u);
  EXPECT_EQ(ranges[1].begin, 1000u);
}

TEST(RangePlan, KeepsRequestsSmallAndLargePiecesWhole) {
  const auto ranges = plan_ranges({piece(0, 60), piece(60, 120), piece(120, 500), piece(500, 510)},
                                  {.max_gap = 0, .max_bytes = 100});
  ASSERT_EQ(ranges.size(), 4u);
  EXPECT_EQ(ranges[2].end - ranges[2].begin, 380u);
  EXPECT_TRUE(plan_ranges({}).empty());
}

TEST(RangePlan, CoversEveryPieceOnce) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<WantedPiece> pieces;
    std::uint64_t at = 0, wanted = 0;
    for (int i = 0; i < 50; ++i) {
      at += random() % 3 == 0 ? random() % 500 : 0;
      const std::uint64_t size = 1 + random() % 300;
      pieces.push_back(piece(at, at + size));
      wanted += size;
      at += size;
    }
    std::shuffle(pieces.begin(), pieces.end(), random);
    std::uint64_t covered = 0, last_end = 0;
    std::size_t count = 0;
    for (const PlannedRange& range : plan_ranges(pieces, {.max_gap = 100, .max_bytes = 1000})) {
      EXPECT_GE(range.begin, last_end);
      last_end = range.end;
      EXPECT_EQ(range.begin, range.pieces.front().begin);
      EXPECT_EQ(range.end, range.pieces.back().end);
      EXPECT_TRUE(range.end - range.begin <= 1000 || range.pieces.size() == 1);
      for (const WantedPiece& one : range.pieces) covered += one.end - one.begin;
      count += range.pieces.size();
    }
    EXPECT_EQ(covered, wanted);
    EXPECT_EQ(count, pieces.size());
  }
}

}  // namespace
}  // namespace selvage
