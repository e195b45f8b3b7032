// SPDX-License-Identifier: MIT
//
// The only door to the logging library. Programs log, libraries return errors: only `*/app` and the server's
// session layer call these. Lines go to stderr, so that stdout stays for results.
#pragma once

#include <string_view>

namespace selvage {

enum class LogLevel { Debug, Info, Warning, Error, Off };

void set_log_level(LogLevel level);

/// Thread-safe; a line each. Format the text before the call, for instance with fmt.
void log(LogLevel level, std::string_view text);

}  // namespace selvage
