// SPDX-License-Identifier: MIT
#include "common/pack/level_choice.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>

namespace selvage {
namespace {

/// The selected regions whose level is still open.
Result<std::vector<RegionId>> open_regions(const Directory& directory, const Selection& selection) {
  auto regions = select_regions(directory, selection);
  if (!regions) return regions;
  std::vector<RegionId> fixed;
  for (const auto& [region, level] : selection.levels) fixed.push_back(region);
  std::ranges::sort(fixed);
  std::erase_if(*regions, [&](RegionId region) { return std::ranges::binary_search(fixed, region); });
  return regions;
}

/// Going finer in one region, and what it gains.
struct Step {
  double error_a_byte = 0;
  RegionId region = 0;
  std::uint8_t level = 0;
  friend bool operator<(const Step& a, const Step& b) {
    if (a.error_a_byte != b.error_a_byte) return a.error_a_byte < b.error_a_byte;
    return a.region > b.region;
  }
};

/// Spends bytes on regions one by one.
class Spender {
 public:
  Spender(const Directory& directory, std::uint64_t left) : directory_(directory), left_(left) {}

  void add(RegionId region) {
    level_of_region_.push_back({region, coarsest(region)});
    queue_best_step(region, coarsest(region));
  }

  /// Steps in order of what they gain a byte; of those that no longer fit, smaller ones are tried.
  std::vector<AtLevel<RegionId>> spend() {
    while (!queue_.empty()) {
      const Step step = queue_.top();
      queue_.pop();
      AtLevel<RegionId>& region =
          *std::ranges::lower_bound(level_of_region_, step.region, {}, &AtLevel<RegionId>::what);
      const std::uint64_t price = bytes(step.region, step.level) - bytes(step.region, region.level);
      if (price <= left_) {
        left_ -= price;
        region.level = step.level;
      }
      queue_best_step(step.region, region.level);
    }
    return level_of_region_;
  }

 private:
  std::uint8_t coarsest(RegionId region) const { return directory_.regions[region].canonical_level(255); }
  std::uint64_t bytes(RegionId region, std::uint32_t level) const {
    return directory_.regions[region].levels[level].part.size;
  }

  /// The finer level that gains most a byte, among those that fit.
  void queue_best_step(RegionId region, std::uint8_t from) {
    Step best;
    for (std::uint8_t level = 0; level < from; ++level) {
      if (directory_.regions[region].levels[level].is_repeat) continue;
      if (bytes(region, level) > bytes(region, from) + left_) continue;
      const double gain = level_error(directory_, region, from) - level_error(directory_, region, level);
      const double price =
          static_cast<double>(bytes(region, level)) - static_cast<double>(bytes(region, from));
      if (gain <= 0) continue;
      const double error_a_byte = price > 0 ? gain / price : HUGE_VAL;
      if (error_a_byte > best.error_a_byte) best = {error_a_byte, region, level};
    }
    if (best.error_a_byte > 0) queue_.push(best);
  }

  const Directory& directory_;
  std::uint64_t left_;
  std::vector<AtLevel<RegionId>> level_of_region_;  // by region
  std::priority_queue<Step> queue_;
};

std::uint64_t bytes_of(const Directory& directory, const std::vector<PartId>& parts) {
  std::uint64_t bytes = 0;
  for (const PartId& part : parts) bytes += directory.find(part)->size;
  return bytes;
}

}  // namespace

double level_error(const Directory& directory, RegionId region, std::uint32_t level) {
  const RegionEntry& entry = directory.regions[region];
  const std::uint8_t at = entry.canonical_level(level);
  if (at == 0 && directory.is_exact) return 0;
  return double{entry.levels[at].deviation} + directory.grid.step * std::sqrt(3.0) / 2;
}

Result<Selection> choose_by_error(const Directory& directory, Selection selection, double max_error) {
  auto regions = open_regions(directory, selection);
  if (!regions) return forward_error(regions);
  for (const RegionId region : *regions) {
    std::uint8_t level = directory.regions[region].canonical_level(255);
    while (level > 0 && level_error(directory, region, level) > max_error) --level;
    const double error = level_error(directory, region, level);
    if (error > max_error) {
      return fail(ErrorCode::InvalidArgument,
                  "an error of " + std::to_string(max_error) + " is less than the " + std::to_string(error) +
                      " that rounding to the pack's grid makes; allow more, or pack with more --bits");
    }
    selection.levels.push_back({region, directory.regions[region].canonical_level(level)});
  }
  return selection;
}

Result<Selection> choose_by_budget(const Directory& directory, Selection selection, std::uint64_t max_bytes) {
  auto regions = open_regions(directory, selection);
  if (!regions) return forward_error(regions);
  Selection coarsest = selection;
  for (const RegionId region : *regions)
    coarsest.levels.push_back({region, directory.regions[region].canonical_level(255)});
  auto parts = select_parts(directory, coarsest);
  if (!parts) return forward_error(parts);
  const std::uint64_t least = bytes_of(directory, *parts);
  if (least > max_bytes) {
    return fail(ErrorCode::LimitExceeded, "the coarsest levels of what is selected, and their joins, take " +
                                              std::to_string(least) + " bytes, more than the budget of " +
                                              std::to_string(max_bytes));
  }
  Spender spender(directory, max_bytes - least);
  for (const RegionId region : *regions) spender.add(region);
  const std::vector<AtLevel<RegionId>> levels = spender.spend();
  selection.levels.insert(selection.levels.end(), levels.begin(), levels.end());
  return selection;
}

}  // namespace selvage
