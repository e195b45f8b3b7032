// SPDX-License-Identifier: MIT
//
// The only door to the logging library. Programs log, libraries return errors: only `*/app` and the server's
// session and publish layers call these. Lines go to stderr, so that stdout stays for results.
//
//     log(LogLevel::Info, "published", {{"model", name}, {"bytes", "4711"}});
//     2026-01-31T12:00:00.000 info published model=bunny bytes=4711
//     {"time":"2026-01-31T12:00:00.000Z","level":"info","message":"published","model":"bunny","bytes":"4711"}
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace selvage {

enum class LogLevel { Debug, Info, Warning, Error, Off };

enum class LogFormat { Text, Json };  ///< Json: one object a line; times are UTC in both

void set_log_level(LogLevel level);
bool is_logged(LogLevel level);  ///< to spare the work for lines that nobody sees
void set_log_format(LogFormat format);

/// Thread-safe; a line each. Format the text before the call, for instance with fmt.
void log(LogLevel level, std::string_view text);

/// What a line is about, by name, so that machines find it: which connection, which request, which model.
/// Values may come from clients: what is not printable does not reach the log as it is.
using LogFields = std::vector<std::pair<std::string_view, std::string>>;
void log(LogLevel level, std::string_view text, const LogFields& fields);

}  // namespace selvage
