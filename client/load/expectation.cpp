// SPDX-License-Identifier: MIT
#include "client/load/expectation.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "client/load/load_report.h"
#include "client/load/units.h"

namespace selvage {
namespace {

using Measure = Expectation::Measure;
using Relation = Expectation::Relation;

constexpr std::array<std::pair<std::string_view, Measure>, 9> kMeasures = {
    {{"p50", Measure::P50},
     {"p90", Measure::P90},
     {"p99", Measure::P99},
     {"p99.9", Measure::P999},
     {"max", Measure::Max},
     {"errors", Measure::Errors},
     {"requests/s", Measure::RequestsPerSecond},
     {"bytes/s", Measure::BytesPerSecond},
     {"useful", Measure::Useful}}};
constexpr std::array<std::pair<std::string_view, Relation>, 5> kRelations = {{{"<", Relation::Below},
                                                                              {"<=", Relation::AtMost},
                                                                              {"=", Relation::Equal},
                                                                              {">=", Relation::AtLeast},
                                                                              {">", Relation::Above}}};

template <class Table>
auto look_up(const Table& table, std::string_view name) -> std::optional<decltype(table[0].second)> {
  for (const auto& [known, value] : table) {
    if (known == name) return value;
  }
  return std::nullopt;
}

bool is_time(Measure measure) { return measure <= Measure::Max; }

std::optional<double> parse_bound(Measure measure, std::string_view text) {
  if (is_time(measure)) return parse_seconds(text);
  if (measure == Measure::Useful) {
    const auto percent = parse_percent(text);
    return percent ? std::optional(*percent / 100) : std::nullopt;
  }
  if (measure == Measure::BytesPerSecond) {
    const auto bytes = parse_size(text);
    return bytes ? std::optional(static_cast<double>(*bytes)) : std::nullopt;
  }
  return parse_plain_number(text);
}

/// All steps whose labels begin with these words.
LatencyHistogram latency_of(const KindReport& total, const std::string& step) {
  LatencyHistogram all;
  if (step == "first region") return total.first_region;
  for (const auto& [label, histogram] : total.latency) {
    if (label == step || label.starts_with(step + " ")) all.merge(histogram);
  }
  return all;
}

double quantile_of(Measure measure) {
  switch (measure) {
    case Measure::P50:
      return 0.5;
    case Measure::P90:
      return 0.9;
    case Measure::P99:
      return 0.99;
    case Measure::P999:
      return 0.999;
    default:
      return 1;
  }
}

bool holds(double measured, Relation relation, double bound) {
  switch (relation) {
    case Relation::Below:
      return measured < bound;
    case Relation::AtMost:
      return measured <= bound;
    case Relation::Equal:
      return measured == bound;
    case Relation::AtLeast:
      return measured >= bound;
    case Relation::Above:
      return measured > bound;
  }
  return false;
}

}  // namespace

Result<Expectation> parse_expectation(const std::vector<std::string>& words) {
  Expectation made;
  for (const std::string& word : words) made.text += (made.text.empty() ? "" : " ") + word;
  const std::size_t count = words.size();
  const auto measure = count >= 3 ? look_up(kMeasures, words[count - 3]) : std::nullopt;
  const auto relation = count >= 3 ? look_up(kRelations, words[count - 2]) : std::nullopt;
  if (!measure || !relation) {
    return fail(ErrorCode::BadFile,
                "'" + made.text +
                    "' is no expectation; write for instance: get p99 < 200ms, first region p50 < 50ms, "
                    "errors = 0, requests/s > 100, bytes/s > 50MB or useful > 90%");
  }
  made.measure = *measure;
  made.relation = *relation;
  for (std::size_t i = 0; i + 3 < count; ++i) made.step += (i > 0 ? " " : "") + words[i];
  if (made.step.empty() == is_time(*measure)) {
    return fail(ErrorCode::BadFile, is_time(*measure)
                                        ? "say of which step: get " + made.text
                                        : "'" + words[count - 3] + "' is of the whole test, not of a step");
  }
  const auto bound = parse_bound(*measure, words[count - 1]);
  if (!bound)
    return fail(ErrorCode::BadFile, "'" + words[count - 1] + "' is no bound of " + words[count - 3]);
  made.bound = *bound;
  return made;
}

Judgement judge(const Expectation& expectation, const LoadReport& report) {
  const KindReport total = report.total();
  const double seconds = std::max(report.elapsed.count(), 1e-9);
  Judgement judgement;
  bool is_known = true;
  switch (expectation.measure) {
    case Measure::Errors:
      judgement.measured = static_cast<double>(total.error_count());
      break;
    case Measure::RequestsPerSecond:
      judgement.measured = static_cast<double>(total.requests) / seconds;
      break;
    case Measure::BytesPerSecond:
      judgement.measured = static_cast<double>(total.useful_bytes) / seconds;
      break;
    case Measure::Useful:
      is_known = total.received_bytes > 0;
      if (is_known)
        judgement.measured =
            static_cast<double>(total.useful_bytes) / static_cast<double>(total.received_bytes);
      break;
    default: {
      const LatencyHistogram latency = latency_of(total, expectation.step);
      is_known = latency.count() > 0;
      const auto time = expectation.measure == Measure::Max
                            ? latency.max()
                            : latency.percentile(quantile_of(expectation.measure));
      judgement.measured = static_cast<double>(time.count()) / 1e9;
    }
  }
  judgement.is_met = is_known && holds(judgement.measured, expectation.relation, expectation.bound);
  return judgement;
}

}  // namespace selvage
