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
/// One line a sample, with a header.
std::string load_csv(const LoadReport& report);
/// A page of its own, without scripts: throughput and latency over time, and percentiles of every step.
std::string load_chart(const LoadReport& report, const std::string& title);

}  // namespace selvage
