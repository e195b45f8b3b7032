// SPDX-License-Identifier: MIT
//
// selvage-load: many scripted clients against one server.
#include <algorithm>
#include <cstdio>

#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "client/app/load_output.h"
#include "client/app/server_options.h"
#include "client/load/run_load.h"
#include "common/base/replace_file.h"
#include "common/base/stop_on_interrupt.h"

namespace {

using namespace selvage;

constexpr const char* kFooter =
    "A script says which clients there are and what they do, one thing a line; docs/LOAD.md has all of it:\n"
    "  duration 30s\n"
    "  ramp 5s                      the clients start over this time\n"
    "  client viewer 200            a kind of client, and how many\n"
    "    link 20mbit 50ms           each has a link of its own\n"
    "    every 500ms                a round starts on time, however long the last one took\n"
    "    open bunny\n"
    "    get random 20%\n"
    "    think 20ms-200ms\n"
    "    get all cancel after 300ms\n"
    "    loop forever\n"
    "  expect get p99 < 200ms\n"
    "  expect errors = 0\n"
    "Example:\n"
    "  selvage-load localhost:7878 --script visit.load --chart visit.html\n"
    "Exit codes: 0 as expected (without expectations: no errors), 1 not so, 2 nothing could be run, 130 "
    "interrupted; what was measured until then is reported.";

enum ExitCode { kAsExpected = 0, kNotAsExpected = 1, kNothingRun = 2, kInterrupted = 130 };

/// Thousands of clients need a descriptor each.
void allow_many_files() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// The table of the moment, in the place of the one before.
class LiveTable {
 public:
  void show(const LoadSample& sample) {
    const std::string text = load_table(sample);
    wipe();
    fmt::print(stderr, "{}", text);
    lines_ = std::ranges::count(text, '\n');
  }
  void wipe() {
    if (lines_ > 0) fmt::print(stderr, "\033[{}A\033[J", lines_);
    lines_ = 0;
  }

 private:
  std::ptrdiff_t lines_ = 0;
};

struct Outputs {
  bool only_check = false;
  bool json = false;
  std::string csv, chart;
};

Result<ExitCode> run(const std::string& server, const std::string& script_path, LoadOptions options,
                     std::optional<std::uint32_t> clients, const std::vector<std::string>& expected,
                     const Outputs& outputs) {
  auto address = parse_host_port(server);
  if (!address) return forward_error(address);
  auto script = read_load_script(script_path);
  if (!script) return forward_error(script);
  if (clients) {
    if (script->kinds.size() > 1)
      return fail(ErrorCode::InvalidArgument,
                  "--clients is for scripts with one kind of client; say how many in the script");
    script->kinds[0].count = *clients;
  }
  for (const std::string& text : expected) {
    std::istringstream in(text);
    auto expectation = parse_expectation({std::istream_iterator<std::string>(in), {}});
    if (!expectation) return forward_error(expectation, "--expect");
    script->expectations.push_back(std::move(*expectation));
  }
  if (outputs.only_check) return fmt::print("{}: sound\n", script_path), kAsExpected;
  options.server = *address;
  LiveTable table;
  const bool is_live = ::isatty(STDERR_FILENO) == 1;
  const StopOnInterrupt interrupt;
  options.on_sample = [&](const LoadSample& sample) {
    if (is_live) table.show(sample);
  };
  const LoadReport report = run_load(*script, options, interrupt.token());
  const bool is_interrupted = interrupt.token().stop_requested();
  table.wipe();

  if (!outputs.csv.empty()) {
    auto ok = replace_file(outputs.csv, load_csv(report));
    if (!ok) return forward_error(ok, outputs.csv);
  }
  if (!outputs.chart.empty()) {
    auto ok = replace_file(outputs.chart, load_chart(report, script_path + " against " + server));
    if (!ok) return forward_error(ok, outputs.chart);
  }
  fmt::print(
      "{}", outputs.json ? load_json(report, script->expectations) : load_text(report, script->expectations));
  if (is_interrupted) {
    std::fprintf(stderr, "selvage-load: interrupted; the report is of what was measured until then\n");
    return kInterrupted;
  }
  const bool is_as_expected = script->expectations.empty()
                                  ? report.total().error_count() == 0
                                  : std::ranges::all_of(script->expectations, [&](const Expectation& e) {
                                      return judge(e, report).is_met;
                                    });
  return is_as_expected ? kAsExpected : kNotAsExpected;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs scripted clients against a selvage server and reports what they saw.", "selvage-load");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.footer(kFooter);
  std::string server, script_path;
  LoadOptions options;
  std::optional<std::uint32_t> clients;
  std::vector<std::string> expected;
  double seconds = 10;
  Outputs outputs;
  app.add_option("SERVER", server, "HOST:PORT")->required();
  app.add_option("--script", script_path, "what the clients do")->required()->type_name("FILE");
  app.add_option("--clients", clients, "how many, where the script has one kind")
      ->check(CLI::Range(1u, 50'000u));
  app.add_option("--duration", seconds, "seconds after which no step begins, where the script does not say")
      ->check(CLI::Range(0.01, 86'400.0))
      ->capture_default_str();
  app.add_option("--max-requests", options.max_requests, "over all clients")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "for the network")
      ->check(CLI::Range(1u, 256u))
      ->capture_default_str();
  app.add_option("--expect", expected, "one more expectation, as the script has them; may be repeated");
  app.add_flag("--check", outputs.only_check,
               "read the script and say whether it is sound; connect to nobody");
  app.add_flag("--json", outputs.json, "print as JSON");
  app.add_option("--csv", outputs.csv, "write samples, one a second, to a file")->type_name("FILE");
  app.add_option("--chart", outputs.chart, "write a page with charts")->type_name("FILE.html");
  ServerOptions connection;
  connection.add_to(app);
  CLI11_PARSE(app, argc, argv);

  allow_many_files();
  options.duration = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  auto client_options = connection.client_options();
  if (!client_options) {
    std::fprintf(stderr, "selvage-load: %s\n", client_options.error().to_string().c_str());
    return kNothingRun;
  }
  options.connection = std::move(*client_options);
  const auto code = run(server, script_path, options, clients, expected, outputs);
  if (!code) {
    std::fprintf(stderr, "selvage-load: %s\n", code.error().to_string().c_str());
    return kNothingRun;
  }
  return *code;
}
