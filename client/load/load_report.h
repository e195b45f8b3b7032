// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "client/load/latency_histogram.h"

namespace selvage {

/// What the clients of one kind saw.
struct KindReport {
  /// By label of step, and "connect". Where rounds start on time (`every`), from when the step would have
  /// begun had the round started then, so that a slow server cannot hide by keeping clients waiting
  /// (coordinated omission); elsewhere from when it was sent.
  std::map<std::string, LatencyHistogram> latency;
  LatencyHistogram first_region;  ///< from a get's start to its first region, decoded if clients decode
  std::map<std::string, std::uint64_t> errors;  ///< by "label: code"
  std::uint64_t requests = 0;                   ///< steps that were answered
  std::uint64_t parts = 0, useful_bytes = 0;    ///< delivered by gets that were not cancelled
  std::uint64_t received_bytes = 0;             ///< of everything on the wire
  std::uint64_t cancelled = 0, dropped = 0;     ///< gets, as the script wants
  std::uint64_t verified = 0;                   ///< gets whose mesh was checked
  std::uint64_t late_rounds = 0;                ///< that could not start on time

  std::uint64_t error_count() const;
  void merge(const KindReport& other);
};

/// How long one step took since the sample before.
struct StepSample {
  std::string label;
  std::uint64_t count = 0;
  LatencyHistogram::Duration p50{}, p90{}, p99{}, max{};
};

/// The load at one moment, for tables and charts.
struct LoadSample {
  double seconds = 0;         ///< from the start of the test
  std::uint32_t clients = 0;  ///< connected
  double requests_per_second = 0, bytes_per_second = 0, errors_per_second = 0;
  double mean_latency_ms = 0;
  std::vector<StepSample> steps;  ///< that were answered since the sample before, by label
};

struct LoadReport {
  std::map<std::string, KindReport> kinds;
  std::vector<LoadSample> samples;
  std::chrono::duration<double> elapsed{};
  bool is_corrected = false;  ///< for coordinated omission, for all kinds

  KindReport total() const;
};

}  // namespace selvage
