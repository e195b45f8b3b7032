// SPDX-License-Identifier: MIT
#include "client/app/status_command.h"

#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace selvage {
namespace {

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array kUnits = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < kUnits.size(); ++unit) value /= 1024;
  return fmt::format("{:.{}f} {}", value, unit == 0 || value >= 100 ? 0 : 1, kUnits[unit]);
}

std::string duration_text(std::uint64_t seconds) {
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{} min {} s", seconds / 60, seconds % 60);
  if (seconds < 86'400) return fmt::format("{} h {} min", seconds / 3600, seconds / 60 % 60);
  return fmt::format("{} d {} h", seconds / 86'400, seconds / 3600 % 24);
}

nlohmann::ordered_json to_json(const StatusReport& status, double ping_ms) {
  nlohmann::ordered_json json = {{"software", status.software},
                                 {"ping_ms", ping_ms},
                                 {"uptime_seconds", status.uptime_seconds},
                                 {"draining", status.draining},
                                 {"encrypted", status.is_encrypted},
                                 {"models", status.models},
                                 {"model_bytes", status.model_bytes},
                                 {"connections", status.connections},
                                 {"max_connections", status.max_connections},
                                 {"connections_accepted", status.connections_accepted},
                                 {"connections_refused", status.connections_refused},
                                 {"requests", status.requests},
                                 {"errors", status.errors},
                                 {"bytes_sent", status.bytes_sent},
                                 {"bytes_uploaded", status.bytes_uploaded},
                                 {"published", status.published},
                                 {"publish_failed", status.publish_failed},
                                 {"problems", nlohmann::ordered_json::array()},
                                 {"jobs", nlohmann::ordered_json::array()}};
  for (const ModelProblem& problem : status.problems)
    json["problems"].push_back({{"model", problem.name}, {"problem", problem.problem}});
  for (const PublishJob& job : status.jobs)
    json["jobs"].push_back({{"model", job.name}, {"stage", job.stage}, {"permille", job.permille}});
  return json;
}

void print_text(const std::string& server, const StatusReport& status, double ping_ms) {
  const auto line = [](const char* what, const std::string& text) {
    fmt::print("  {:<12} {}\n", what, text);
  };
  fmt::print("{}: {}, {}\n", server, status.software, status.draining ? "shutting down" : "serving");
  line("up", fmt::format("{}, answers in {:.1f} ms, {}", duration_text(status.uptime_seconds), ping_ms,
                         status.is_encrypted ? "encrypted" : "not encrypted"));
  line("models",
       fmt::format("{}, {}{}", status.models, bytes_text(status.model_bytes),
                   status.problems.empty() ? "" : fmt::format(", {} damaged", status.problems.size())));
  line("connections",
       fmt::format("{} of {}; {} so far, {} turned away", status.connections, status.max_connections,
                   status.connections_accepted, status.connections_refused));
  line("requests",
       fmt::format("{}, {} errors, {} sent", status.requests, status.errors, bytes_text(status.bytes_sent)));
  line("published", fmt::format("{}, {} failed, {} received", status.published, status.publish_failed,
                                bytes_text(status.bytes_uploaded)));
  for (const PublishJob& job : status.jobs)
    line("  working on", fmt::format("{}: {} {} %", job.name, job.stage, job.permille / 10));
  for (const ModelProblem& problem : status.problems) line("  damaged", problem.problem);
}

}  // namespace

Result<void> run(const StatusCommand& command) {
  auto client = command.connection.connect(command.server);
  if (!client) return forward_error(client);
  auto ping = client->ping();
  if (!ping) return forward_error(ping, command.server);
  auto status = client->status();
  if (!status) return forward_error(status, command.server);
  const double ping_ms = std::chrono::duration<double, std::milli>(*ping).count();
  if (command.json) {
    fmt::print("{}\n", to_json(*status, ping_ms).dump(2));
  } else {
    print_text(command.server, *status, ping_ms);
  }
  return {};
}

}  // namespace selvage
