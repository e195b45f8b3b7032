// SPDX-License-Identifier: MIT
//
// selvage-load: many scripted clients against one server.
#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/load/scripted_client.h"

namespace {

using namespace selvage;

constexpr const char* kFooter =
    "A script has one step a line; # starts a comment:\n"
    "  list                  ask for the models\n"
    "  open NAME             open a model\n"
    "  get all               fetch everything; also: get 3,5-7 and get random 20%\n"
    "  wait 50ms             think; also 2s\n"
    "  repeat 10             start again; also: repeat forever\n"
    "Example:\n"
    "  printf 'open bunny\\nget random 20%\\nwait 50ms\\nget all\\nrepeat forever\\n' > visit.txt\n"
    "  selvage-load localhost:7878 --script visit.txt --clients 100 --duration 30\n"
    "Clients fetch and do not decode. Latency is from sending a request to its answer; it is not corrected "
    "for\n"
    "coordinated omission. Exit codes: 0 no client met an error, 1 some did, 2 nothing could be run.";

double milliseconds(LatencyHistogram::Duration duration) {
  return static_cast<double>(duration.count()) / 1e6;
}

nlohmann::ordered_json to_json(const LatencyHistogram& latency) {
  return {{"count", latency.count()},
          {"p50_ms", milliseconds(latency.percentile(0.5))},
          {"p90_ms", milliseconds(latency.percentile(0.9))},
          {"p99_ms", milliseconds(latency.percentile(0.99))},
          {"max_ms", milliseconds(latency.max())}};
}

void print_json(const LoadReport& report) {
  const double seconds = report.elapsed.count();
  nlohmann::ordered_json json = {{"seconds", seconds},
                                 {"requests", report.requests},
                                 {"requests_per_second", static_cast<double>(report.requests) / seconds},
                                 {"parts", report.parts},
                                 {"part_bytes", report.bytes},
                                 {"part_bytes_per_second", static_cast<double>(report.bytes) / seconds},
                                 {"errors", report.errors},
                                 {"time_to_first_region", to_json(report.first_region)}};
  for (const auto& [kind, latency] : report.latency) json["latency"][kind] = to_json(latency);
  fmt::print("{}\n", json.dump(2));
}

void print_row(const std::string& what, const LatencyHistogram& latency) {
  fmt::print("{:<22} {:>9} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}\n", what, latency.count(),
             milliseconds(latency.percentile(0.5)), milliseconds(latency.percentile(0.9)),
             milliseconds(latency.percentile(0.99)), milliseconds(latency.max()));
}

void print_text(const LoadReport& report) {
  const double seconds = report.elapsed.count();
  fmt::print("{} requests in {:.2f} s, {:.0f} a second; {} parts, {:.1f} MB/s\n\n", report.requests, seconds,
             static_cast<double>(report.requests) / seconds, report.parts,
             static_cast<double>(report.bytes) / seconds / 1e6);
  fmt::print("{:<22} {:>9} {:>10} {:>10} {:>10} {:>10}\n", "latency, ms", "count", "p50", "p90", "p99",
             "max");
  for (const auto& [kind, latency] : report.latency) print_row(kind, latency);
  print_row("time to first region", report.first_region);
  for (const auto& [code, count] : report.errors)
    fmt::print("\n{} clients stopped at an error: {}", count, code);
  if (!report.errors.empty()) fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs scripted clients against a selvage server and reports what they saw.", "selvage-load");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.footer(kFooter);
  std::string server, script_path;
  LoadOptions options;
  double seconds = 10;
  bool json = false;
  app.add_option("SERVER", server, "HOST:PORT")->required();
  app.add_option("--script", script_path, "what each client does")->required()->type_name("FILE");
  app.add_option("--clients", options.clients, "at the same time")
      ->check(CLI::Range(1u, 20'000u))
      ->capture_default_str();
  app.add_option("--duration", seconds, "seconds after which no step begins")
      ->check(CLI::Range(0.01, 86'400.0))
      ->capture_default_str();
  app.add_option("--max-requests", options.max_requests, "over all clients")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "for the network; 0: one")
      ->check(CLI::Range(0u, 256u))
      ->capture_default_str();
  app.add_flag("--json", json, "print as JSON");
  CLI11_PARSE(app, argc, argv);

  auto address = parse_host_port(server);
  auto script = read_load_script(script_path);
  if (!address || !script) {
    const Error& error = address ? script.error() : address.error();
    std::fprintf(stderr, "selvage-load: %s\n", error.to_string().c_str());
    return 2;
  }
  options.server = *address;
  options.duration = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  const LoadReport report = run_load(*script, options);
  if (json) {
    print_json(report);
  } else {
    print_text(report);
  }
  return report.errors.empty() ? 0 : 1;
}
