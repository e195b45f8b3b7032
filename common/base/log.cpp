// SPDX-License-Identifier: MIT
#include "common/base/log.h"

#include <algorithm>
#include <atomic>
#include <string>

#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace selvage {
namespace {

constexpr const char* kTextPattern = "%Y-%m-%dT%H:%M:%S.%eZ %^%l%$ %v";
constexpr const char* kJsonPattern = R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})";

std::atomic<LogFormat> g_format = LogFormat::Text;

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto created = spdlog::stderr_color_mt("selvage");
    created->set_pattern(kTextPattern, spdlog::pattern_time_type::utc);
    return created;
  }();
  return *instance;
}

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::Debug:
      return spdlog::level::debug;
    case LogLevel::Info:
      return spdlog::level::info;
    case LogLevel::Warning:
      return spdlog::level::warn;
    case LogLevel::Error:
      return spdlog::level::err;
    case LogLevel::Off:
      break;
  }
  return spdlog::level::off;
}

/// A JSON string. Control characters and what is no ASCII are escaped or replaced: a log line stays one line,
/// whatever a client calls itself.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7F) {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

bool needs_quotes(std::string_view text) {
  return text.empty() || std::ranges::any_of(text, [](char c) {
           return static_cast<unsigned char>(c) <= 0x20 || c == '"' || c == '=' || c == '\\' || c == 0x7F;
         });
}

std::string to_json(std::string_view text, const LogFields& fields) {
  std::string line = "\"message\":" + quoted(text);
  for (const auto& [name, value] : fields) line += ',' + quoted(name) + ':' + quoted(value);
  return line;
}

std::string to_text(std::string_view text, const LogFields& fields) {
  std::string line(text);
  for (const auto& [name, value] : fields) {
    line += ' ';
    line += name;
    line += '=' + (needs_quotes(value) ? quoted(value) : value);
  }
  return line;
}

}  // namespace

void set_log_level(LogLevel level) { logger().set_level(to_spdlog(level)); }

bool is_logged(LogLevel level) { return logger().should_log(to_spdlog(level)); }

void set_log_format(LogFormat format) {
  g_format = format;
  logger().set_pattern(format == LogFormat::Json ? kJsonPattern : kTextPattern,
                       spdlog::pattern_time_type::utc);
}

void log(LogLevel level, std::string_view text) { log(level, text, {}); }

void log(LogLevel level, std::string_view text, const LogFields& fields) {
  if (!is_logged(level)) return;
  const std::string line = g_format == LogFormat::Json ? to_json(text, fields) : to_text(text, fields);
  logger().log(to_spdlog(level), spdlog::string_view_t(line.data(), line.size()));
}

}  // namespace selvage
