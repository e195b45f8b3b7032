// SPDX-License-Identifier: MIT
#include "client/app/load_output.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace selvage {
namespace {

using Json = nlohmann::ordered_json;

double milliseconds(LatencyHistogram::Duration duration) {
  return static_cast<double>(duration.count()) / 1e6;
}

double per_second(std::uint64_t count, const LoadReport& report) {
  return static_cast<double>(count) / std::max(report.elapsed.count(), 1e-9);
}

double useful_share(const KindReport& kind) {
  if (kind.received_bytes == 0) return 0;
  return static_cast<double>(kind.useful_bytes) / static_cast<double>(kind.received_bytes);
}

Json to_json(const LatencyHistogram& latency) {
  return {{"count", latency.count()},
          {"p50_ms", milliseconds(latency.percentile(0.5))},
          {"p90_ms", milliseconds(latency.percentile(0.9))},
          {"p99_ms", milliseconds(latency.percentile(0.99))},
          {"p999_ms", milliseconds(latency.percentile(0.999))},
          {"max_ms", milliseconds(latency.max())}};
}

Json to_json(const KindReport& kind, const LoadReport& report) {
  Json json = {{"requests", kind.requests},
               {"requests_per_second", per_second(kind.requests, report)},
               {"parts", kind.parts},
               {"useful_bytes", kind.useful_bytes},
               {"useful_bytes_per_second", per_second(kind.useful_bytes, report)},
               {"received_bytes", kind.received_bytes},
               {"useful_share", useful_share(kind)},
               {"cancelled", kind.cancelled},
               {"dropped", kind.dropped},
               {"verified", kind.verified},
               {"late_rounds", kind.late_rounds},
               {"errors", kind.errors},
               {"time_to_first_region", to_json(kind.first_region)}};
  for (const auto& [label, latency] : kind.latency) json["latency"][label] = to_json(latency);
  return json;
}

std::string row(const std::string& what, const LatencyHistogram& latency) {
  return fmt::format("  {:<34} {:>9} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}\n", what.substr(0, 34),
                     latency.count(), milliseconds(latency.percentile(0.5)),
                     milliseconds(latency.percentile(0.9)), milliseconds(latency.percentile(0.99)),
                     milliseconds(latency.max()));
}

std::string kind_text(const std::string& name, const KindReport& kind) {
  std::string text = fmt::format("\n  {:<34} {:>9} {:>10} {:>10} {:>10} {:>10}\n", name + ": latency, ms",
                                 "count", "p50", "p90", "p99", "max");
  for (const auto& [label, latency] : kind.latency) text += row(label, latency);
  if (kind.first_region.count() > 0) text += row("time to first region", kind.first_region);
  if (kind.cancelled > 0)
    text += fmt::format("  {} gets were cancelled, as the script says\n", kind.cancelled);
  if (kind.dropped > 0) text += fmt::format("  {} gets were resumed on another connection\n", kind.dropped);
  if (kind.verified > 0) text += fmt::format("  {} gets were verified\n", kind.verified);
  if (kind.late_rounds > 0) text += fmt::format("  {} rounds could not start on time\n", kind.late_rounds);
  for (const auto& [what, count] : kind.errors) text += fmt::format("  {} errors at {}\n", count, what);
  return text;
}

}  // namespace

std::string load_text(const LoadReport& report, const std::vector<Expectation>& expectations) {
  const KindReport total = report.total();
  std::string text = fmt::format(
      "{} requests in {:.2f} s, {:.0f} a second; {} parts, {:.1f} MB/s; {:.1f} % of the received bytes were "
      "useful; {} errors\n",
      total.requests, report.elapsed.count(), per_second(total.requests, report), total.parts,
      per_second(total.useful_bytes, report) / 1e6, 100 * useful_share(total), total.error_count());
  for (const auto& [name, kind] : report.kinds) text += kind_text(name, kind);
  text += report.is_corrected ? "\nLatency is from when a step was due: corrected for coordinated omission.\n"
                              : "\nLatency is from when a request was sent, where a kind has no `every`: "
                                "there it is not corrected "
                                "for coordinated omission.\n";
  for (const Expectation& expectation : expectations) {
    const Judgement judgement = judge(expectation, report);
    text += fmt::format("{}: {} (measured {:.6g})\n", judgement.is_met ? "met" : "NOT MET", expectation.text,
                        judgement.measured);
  }
  return text;
}

std::string load_json(const LoadReport& report, const std::vector<Expectation>& expectations) {
  Json json = {{"seconds", report.elapsed.count()},
               {"corrected_for_coordinated_omission", report.is_corrected},
               {"total", to_json(report.total(), report)}};
  for (const auto& [name, kind] : report.kinds) json["kinds"][name] = to_json(kind, report);
  json["expectations"] = Json::array();
  for (const Expectation& expectation : expectations) {
    const Judgement judgement = judge(expectation, report);
    json["expectations"].push_back(
        {{"text", expectation.text}, {"met", judgement.is_met}, {"measured", judgement.measured}});
  }
  return json.dump(2) + "\n";
}

std::string load_table(const LoadSample& s) {
  std::string text = fmt::format(
      "{:.0f} s: {} clients, {:.0f} requests/s, {:.1f} MB/s, {:.1f} errors/s\n  {:<34} {:>9} {:>10} {:>10} "
      "{:>10} {:>10}\n",
      s.seconds, s.clients, s.requests_per_second, s.bytes_per_second / 1e6, s.errors_per_second,
      "latency of the last moment, ms", "count", "p50", "p90", "p99", "max");
  for (const StepSample& step : s.steps) {
    text += fmt::format("  {:<34} {:>9} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}\n", step.label.substr(0, 34),
                        step.count, milliseconds(step.p50), milliseconds(step.p90), milliseconds(step.p99),
                        milliseconds(step.max));
  }
  return text;
}

std::string load_csv(const LoadReport& report) {
  std::string text =
      "seconds,clients,requests_per_second,bytes_per_second,errors_per_second,mean_latency_ms,step,count,p50_"
      "ms,p90_ms,"
      "p99_ms,max_ms\n";
  for (const LoadSample& s : report.samples) {
    text += fmt::format("{:.3f},{},{:.1f},{:.0f},{:.1f},{:.3f},,,,,,\n", s.seconds, s.clients,
                        s.requests_per_second, s.bytes_per_second, s.errors_per_second, s.mean_latency_ms);
    for (const StepSample& step : s.steps) {
      text += fmt::format("{:.3f},{},,,,,\"{}\",{},{:.3f},{:.3f},{:.3f},{:.3f}\n", s.seconds, s.clients,
                          step.label, step.count, milliseconds(step.p50), milliseconds(step.p90),
                          milliseconds(step.p99), milliseconds(step.max));
    }
  }
  return text;
}

}  // namespace selvage
