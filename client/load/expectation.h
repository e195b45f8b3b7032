// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "common/base/result.h"

namespace selvage {

struct LoadReport;

/// A bound on what a load test measures: "get p99 < 200ms", "errors = 0", "useful > 90%".
struct Expectation {
  /// Times are those of a step; the others are of the whole test.
  enum class Measure { P50, P90, P99, P999, Max, Errors, RequestsPerSecond, BytesPerSecond, Useful };
  enum class Relation { Below, AtMost, Equal, AtLeast, Above };

  std::string text;  ///< as it was written
  std::string step;  ///< the first words of the labels of the steps that are meant; empty where none is
  Measure measure = Measure::Errors;
  Relation relation = Relation::Equal;
  double bound = 0;  ///< seconds, bytes a second, a share (1 is all), or a count
};

/// From the words after `expect`. BadFile says what is wrong.
Result<Expectation> parse_expectation(const std::vector<std::string>& words);

struct Judgement {
  bool is_met = false;
  double measured = 0;  ///< in the unit of the bound
};

/// An expectation of steps that never happened is not met.
Judgement judge(const Expectation& expectation, const LoadReport& report);

}  // namespace selvage
