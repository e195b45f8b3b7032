// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/load/expectation.h"
#include "client/load/load_report.h"

namespace selvage {

/// What a load test measured, for people, programs and spreadsheets.
std::string load_text(const LoadReport& report, const std::vector<Expectation>& expectations);
std::string load_json(const LoadReport& report, const std::vector<Expectation>& expectations);
/// Some lines about one moment: what went on, and latency by step.
std::string load_table(const LoadSample& sample);

/// A line a sample, and one for each of its steps: rows whose `step` is empty are of all of them.
std::string load_csv(const LoadReport& report);
/// A page of its own, without scripts: throughput and latency over time, and percentiles of every step.
std::string load_chart(const LoadReport& report, const std::string& title);

}  // namespace selvage
