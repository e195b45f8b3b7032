// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>

namespace selvage {

/// Durations in buckets of constant relative width: 64 to an octave of nanoseconds, so a percentile is off by
/// at most 1/128 of itself. Fixed memory whatever the number of durations. (No histogram library is packaged
/// for C++.)
class LatencyHistogram {
 public:
  using Duration = std::chrono::nanoseconds;

  void add(Duration duration) {
    ++counts_[bucket_of(value_of(duration))];
    ++count_;
    max_ = std::max(max_, duration);
  }

  void merge(const LatencyHistogram& other) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
    count_ += other.count_;
    max_ = std::max(max_, other.max_);
  }

  std::uint64_t count() const { return count_; }
  Duration max() const { return max_; }

  /// The least duration that a share `quantile` (0..1] of all does not exceed; 0 if there is none.
  Duration percentile(double quantile) const {
    const auto rank = static_cast<std::uint64_t>(quantile * static_cast<double>(count_) + 0.5);
    if (rank >= count_) return max_;
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      seen += counts_[i];
      if (seen >= rank && seen > 0) return std::min(max_, Duration(middle_of(i)));
    }
    return max_;
  }

 private:
  static constexpr int kStepBits = 6;

  static std::uint64_t value_of(Duration duration) {
    return duration.count() < 0 ? 0 : static_cast<std::uint64_t>(duration.count());
  }

  // Below 2^(kStepBits + 1) a bucket is one nanosecond wide; each octave above has 2^kStepBits buckets.
  static std::size_t bucket_of(std::uint64_t ns) {
    const int octave = std::max(0, static_cast<int>(std::bit_width(ns)) - 1 - kStepBits);
    return (static_cast<std::size_t>(octave) << kStepBits) + static_cast<std::size_t>(ns >> octave);
  }

  static std::int64_t middle_of(std::size_t bucket) {
    const std::size_t octave = bucket < (2u << kStepBits) ? 0 : (bucket >> kStepBits) - 1;
    const std::uint64_t low = (bucket - (octave << kStepBits)) << octave;
    return static_cast<std::int64_t>(low + ((std::uint64_t{1} << octave) >> 1));
  }

  std::array<std::uint64_t, (64 - kStepBits + 1) << kStepBits> counts_{};
  std::uint64_t count_ = 0;
  Duration max_{0};
};

}  // namespace selvage
