// SPDX-License-Identifier: MIT
#include "common/pack/level_choice.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "common/coding/byte_io.h"
#include "common/pack/pack.h"

namespace selvage {
namespace {

/// Regions without joins, each with up to three levels of random sizes and errors; some repeat.
Directory random_directory(std::uint32_t regions, std::uint32_t seed) {
  std::mt19937 random(seed);
  Directory directory;
  directory.grid = Grid{.step = 0.001, .bits = 12};
  directory.regions.resize(regions + 1);
  for (RegionId id = 1; id <= regions; ++id) {
    auto& levels = directory.regions[id].levels;
    levels.push_back({.part = {.size = 300 + static_cast<std::uint32_t>(random() % 3000)}, .vertices = 9});
    while (levels.size() < 3) {
      LevelEntry coarser = levels.back();
      coarser.is_repeat = random() % 4 == 0;
      if (!coarser.is_repeat) {
        coarser.part.size = 1 + static_cast<std::uint32_t>(random() % coarser.part.size);
        coarser.deviation += static_cast<float>(random() % 100) / 16;
      }
      levels.push_back(coarser);
    }
  }
  return directory;
}

struct Outcome {
  std::uint64_t bytes = 0;
  double error = 0, largest = 0;
};

Outcome outcome_of(const Directory& directory, const Selection& selection) {
  Outcome outcome;
  const auto parts = select_parts(directory, selection).value();
  for (const PartId& part : parts) {
    outcome.bytes += directory.find(part)->size;
    const double error = level_error(directory, part.region, part.level);
    outcome.error += error;
    outcome.largest = std::max(outcome.largest, error);
  }
  return outcome;
}

/// The least sum of errors of all choices of levels within the budget.
double least_error(const Directory& directory, std::uint64_t budget) {
  const std::uint32_t regions = directory.real_region_count();
  std::uint32_t choices = 1;
  for (RegionId id = 1; id <= regions; ++id) choices *= 3;
  double least = HUGE_VAL;
  for (std::uint32_t choice = 0; choice < choices; ++choice) {
    Selection selection;
    for (std::uint32_t id = 1, rest = choice; id <= regions; ++id, rest /= 3)
      selection.levels.push_back({id, static_cast<std::uint8_t>(rest % 3)});
    const Outcome outcome = outcome_of(directory, selection);
    if (outcome.bytes <= budget) least = std::min(least, outcome.error);
  }
  return least;
}

TEST(LevelChoice, BudgetComesWithinOneStepOfTheExhaustiveOptimum) {
  int optimal = 0, cases = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Directory directory = random_directory(5, seed);
    double largest_step = 0;
    for (RegionId id = 1; id <= 5; ++id)
      largest_step = std::max(largest_step, level_error(directory, id, 2) - level_error(directory, id, 0));
    const std::uint64_t least = outcome_of(directory, {.level = 2}).bytes;
    const std::uint64_t most = outcome_of(directory, {}).bytes;
    for (int i = 0; i <= 4; ++i) {
      const std::uint64_t budget = least + (most - least) * static_cast<std::uint64_t>(i) / 4;
      const auto chosen = choose_by_budget(directory, {}, budget);
      ASSERT_TRUE(chosen) << chosen.error().message;
      const Outcome outcome = outcome_of(directory, *chosen);
      const double optimum = least_error(directory, budget);
      EXPECT_LE(outcome.bytes, budget);
      EXPECT_LE(outcome.error, optimum + largest_step);
      optimal += outcome.error <= optimum + 1e-9;
      ++cases;
    }
  }
  EXPECT_GE(optimal, cases / 2);
}

TEST(LevelChoice, BudgetForEverythingGivesTheFinest) {
  const Directory directory = random_directory(40, 7);
  const Outcome finest = outcome_of(directory, {});
  EXPECT_EQ(outcome_of(directory, choose_by_budget(directory, {}, finest.bytes).value()).error, finest.error);
}

TEST(LevelChoice, BudgetBelowTheCoarsestLevelsSaysWhatTheyTake) {
  const Directory directory = random_directory(6, 1);
  const std::uint64_t least = outcome_of(directory, {.level = 2}).bytes;
  EXPECT_TRUE(choose_by_budget(directory, {}, least));
  const auto refused = choose_by_budget(directory, {}, least - 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::LimitExceeded);
  EXPECT_NE(refused.error().message.find(std::to_string(least)), std::string::npos);
}

TEST(LevelChoice, ErrorGivesTheCoarsestLevelsWithinIt) {
  const Directory directory = random_directory(30, 3);
  for (double error : {0.01, 1.0, 3.0, 100.0}) {
    const auto chosen = choose_by_error(directory, {}, error);
    ASSERT_TRUE(chosen) << chosen.error().message;
    EXPECT_LE(outcome_of(directory, *chosen).largest, error);
    for (const auto& [region, level] : chosen->levels) {
      for (std::uint8_t coarser = level; coarser < 3; ++coarser) {
        if (directory.regions[region].canonical_level(coarser) == level) continue;
        EXPECT_GT(level_error(directory, region, coarser), error);
      }
    }
  }
  const auto refused = choose_by_error(directory, {}, 0.0005);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
}

TEST(LevelChoice, KeepsLevelsThatWereAskedFor) {
  const Directory directory = random_directory(4, 5);
  const Selection asked{.levels = {{2, 0}, {3, 2}}};
  for (const auto& chosen :
       {choose_by_error(directory, asked, 100), choose_by_budget(directory, asked, 9000)}) {
    ASSERT_TRUE(chosen) << chosen.error().message;
    const auto parts = select_parts(directory, *chosen).value();
    EXPECT_EQ(parts[1].level, 0);
    EXPECT_EQ(parts[2].level, directory.regions[3].canonical_level(2));
  }
}

}  // namespace
}  // namespace selvage
